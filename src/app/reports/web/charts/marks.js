'use strict';
// What is drawn into a chart beside its data: bands and lines at values of an axis, and the cursor of the replay. What lies
// off the scale has an arrow at the edge, and the key says so: never a line as if it were there.

// Bands of "options.pbmpi": at values of the y axis, or of the axis that they name. As long as a horizontal chart has its
// values along x, "y" means these.
pb.bandAxis = (chart, band) => {
  const axis = band.axis || 'y';
  return chart.options.indexAxis === 'y' ? (axis === 'y' ? 'x' : 'y') : axis;
};

// Where a band lies: {place: 'in' | 'below' | 'above', from, to}, cut to the axis.
pb.bandPlace = (scale, {from, to}) => {
  if (to < scale.min || (to <= 0 && scale.type === 'logarithmic')) return {place: 'below'};
  if (from > scale.max) return {place: 'above'};
  return {place: 'in', from: Math.max(from, scale.min), to: Math.min(to, scale.max)};
};

pb.drawBand = (chart, band) => {
  const {ctx, chartArea: area} = chart;
  const axis = pb.bandAxis(chart, band);
  const {place, from, to} = pb.bandPlace(chart.scales[axis], band);
  const isLine = band.from === band.to;
  ctx.fillStyle = ctx.strokeStyle = isLine ? pb.visible(band.colour) : band.colour;
  if (place !== 'in') {
    ctx.fillStyle = pb.themeColour('ink');
    pb.drawArrow(ctx, area, axis, place);
    return;
  }
  const [a, b] = [from, to].map((value) => chart.scales[axis].getPixelForValue(value));
  const low = Math.min(a, b), size = Math.max(1.5, Math.abs(a - b));
  if (!isLine) {
    if (axis === 'y') ctx.fillRect(area.left, low, area.width, size); else ctx.fillRect(low, area.top, size, area.height);
    return;
  }
  ctx.lineWidth = 1.5;
  ctx.setLineDash(band.dash || []);
  ctx.beginPath();
  if (axis === 'y') { ctx.moveTo(area.left, a); ctx.lineTo(area.right, a); } else { ctx.moveTo(a, area.top); ctx.lineTo(a, area.bottom); }
  ctx.stroke();
};

// A triangle at the end of the axis beyond which something lies.
pb.drawArrow = (ctx, area, axis, place) => {
  const turn = {y: {below: 0, above: Math.PI}, x: {below: Math.PI / 2, above: -Math.PI / 2}}[axis][place];
  const x = axis === 'y' ? area.right - 8 : place === 'below' ? area.left + 6 : area.right - 6;
  const y = axis === 'x' ? area.top + 8 : place === 'below' ? area.bottom - 6 : area.top + 6;
  ctx.save();
  ctx.translate(x, y);
  ctx.rotate(turn);
  ctx.beginPath();
  ctx.moveTo(0, 5);
  ctx.lineTo(5, -4);
  ctx.lineTo(-5, -4);
  ctx.fill();
  ctx.restore();
};

pb.shortNumber = (value) => Number(value.toPrecision(3)).toString();

// The key's line of a band.
pb.bandEntry = (chart, band) => {
  const isLine = band.from === band.to;
  const {place} = pb.bandPlace(chart.scales[pb.bandAxis(chart, band)], band);
  const value = band.showValue === false ? '' : `: ${isLine || band.from === 0 ? '' : `${pb.shortNumber(band.from)} to `}${pb.shortNumber(band.to)}`;
  const off = {in: '', below: ', below the scale', above: ', above the scale'}[place];
  const ink = pb.themeColour('ink');
  const look = place !== 'in' ? {shape: place === 'below' ? 'down' : 'up', fill: ink, stroke: ink} :
      isLine ? {shape: 'line', stroke: pb.visible(band.colour), dash: band.dash} : {shape: 'bar', fill: band.colour, stroke: pb.themeColour('edge')};
  return {label: `${band.label}${value}${off}`, look};
};

pb.marksPlugin = {
  id: 'pbmpi',
  beforeDatasetsDraw(chart, _, options) {
    chart.ctx.save();
    for (const band of options.bands || []) pb.drawBand(chart, band);
    chart.ctx.restore();
  },
  afterDatasetsDraw(chart, _, options) {
    if (options.cursor === undefined || chart.cursor === undefined) return;
    const {ctx, chartArea: area, scales} = chart;
    const x = scales.x.getPixelForValue(Math.min(scales.x.max, Math.max(scales.x.min, chart.cursor)));
    ctx.save();
    ctx.strokeStyle = pb.themeColour('ink');
    ctx.lineWidth = 1.5;
    ctx.beginPath();
    ctx.moveTo(x, area.top);
    ctx.lineTo(x, area.bottom);
    ctx.stroke();
    ctx.restore();
  },
};
