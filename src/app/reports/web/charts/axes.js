'use strict';
// Logarithmic axes: ends at 1, 2 or 5 times a power of ten, a label at each decade, lines between.

pb.superscript = (number) => String(number).replace(/./g, (c) => c === '-' ? '\u207b' : '\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079'[c]);

pb.powerText = (exponent, short) => exponent >= (short ? 0 : -3) && exponent <= (short ? 1 : 4) ? (10 ** exponent).toFixed(Math.max(0, -exponent)) :
                                                             `10${pb.superscript(exponent)}`;

// The largest of 1, 2, 5 times a power of ten that is not above (up: the least that is not below) the value.
pb.roundTo125 = (value, up) => {
  const decade = 10 ** Math.floor(Math.log10(value) + 1e-9);
  const steps = [1, 2, 5, 10].map((step) => Number((step * decade).toPrecision(6)));
  return up ? steps.find((step) => step >= value * (1 - 1e-9)) : [...steps].reverse().find((step) => step <= value * (1 + 1e-9));
};

// Ends of an axis that shows all these numbers; those that a logarithm cannot have are left out. At least one power of
// ten lies between, so that there is a label.
pb.logLimits = (values, room = 1.25) => {
  const positive = values.filter((value) => value > 0 && isFinite(value));
  if (positive.length === 0) return null;
  let low = pb.roundTo125(Math.min(...positive) / room, false), high = pb.roundTo125(Math.max(...positive) * room, true);
  const exponent = Math.floor(Math.log10(high) + 1e-9);
  if (10 ** exponent < low * (1 - 1e-9)) {  // between two decades: the nearer one is added
    if (low / 10 ** exponent < 10 ** (exponent + 1) / high) low = 10 ** exponent; else high = 10 ** (exponent + 1);
  }
  return {min: Number(low.toPrecision(6)), max: Number(high.toPrecision(6))};
};

// [{value, label}]: each decade has its label, as a power of ten where `roomPx` a label is not there; where even
// `leastPx` is not, every second, third, ... has one. Within two decades 2 and 5 have one, too.
pb.logTicks = (min, max, lengthPx, roomPx, leastPx) => {
  const first = Math.floor(Math.log10(min) + 1e-9), last = Math.ceil(Math.log10(max) - 1e-9);
  const decades = Math.log10(max / min);
  const every = Math.max(1, Math.ceil(decades * leastPx / lengthPx));
  const short = decades * roomPx > lengthPx;
  const fine = decades <= 2 && 3.4 * decades * roomPx < lengthPx;
  const ticks = [];
  for (let exponent = first; exponent <= last; ++exponent) {
    for (let step = 1; step < 10; ++step) {
      const value = Number(`${step}e${exponent}`);
      if (value < min * (1 - 1e-9) || value > max * (1 + 1e-9)) continue;
      let label = '';
      if (step === 1 && exponent % every === 0) label = pb.powerText(exponent, short);
      if (fine && (step === 2 || step === 5)) label = String(Number(value.toPrecision(1)));
      if (step === 1 || decades <= 6) ticks.push({value, label});
    }
  }
  return ticks;
};

// Makes a scale of a Chart.js configuration logarithmic as above, over these numbers. Without a positive one it stays
// linear.
pb.makeLogScale = (scale, values, room) => {
  const limits = pb.logLimits(values, room);
  if (limits === null) {
    scale.type = 'linear';
    scale.min = 0;
    scale.max = 1;
    return;
  }
  Object.assign(scale, {type: 'logarithmic', ...limits});
  let labels = new Map(), crowded = false;
  scale.afterBuildTicks = (axis) => {
    const ticks = axis.isHorizontal() ? pb.logTicks(axis.min, axis.max, axis.maxWidth, 44, 22) :
                                        pb.logTicks(axis.min, axis.max, axis.maxHeight, 16, 13);
    crowded = axis.isHorizontal() && 30 * Math.log10(axis.max / axis.min) > axis.maxWidth;
    labels = new Map(ticks.map((tick) => [tick.value, tick.label]));
    axis.ticks = ticks.map(({value}) => ({value}));
  };
  scale.ticks = {...scale.ticks, autoSkip: false, maxRotation: 0, font: () => ({size: crowded ? 9.5 : 12}), callback: (value) => labels.get(value) ?? ''};
};
