'use strict';
// Charts of all pages: Chart.js with axes, marks, key and reading as the sources before this one have them.

// The axis of values: x, if bars lie. Plain numbers and bands without an axis belong to it.
pb.valueAxis = (config) => config.options.indexAxis === 'y' ? 'x' : 'y';

// The number that a point has on an axis; NaN: none.
pb.numberOf = (config, point, axis) => {
  if (point === null || typeof point !== 'object') return axis === pb.valueAxis(config) && point !== null ? point : NaN;
  return Number(point[axis]);
};

// Bands no more than a decade away from the data stretch a logarithmic axis; what is farther off gets an arrow.
pb.valuesOnLogAxis = (config, axis) => {
  const numbers = config.data.datasets.flatMap((dataset) => dataset.data.map((point) => pb.numberOf(config, point, axis)));
  const values = numbers.filter((value) => value > 0 && isFinite(value));
  const low = Math.min(...values) / 10, high = Math.max(...values) * 10;
  const bands = config.options.plugins.pbmpi?.bands || [];
  const near = bands.filter((band) => pb.bandAxis(config, band) === axis).flatMap((band) => [band.from, band.to]);
  return [...values, ...near.filter((value) => value >= low && value <= high)];
};

// A point at or below 0 stands at the end of a logarithmic axis, as an arrow, and says so.
pb.markOffScale = (config, axis, scale) => {
  for (const dataset of config.data.datasets) {
    const shapes = dataset.data.map((_, index) => Array.isArray(dataset.pointStyle) ? dataset.pointStyle[index] : dataset.pointStyle || 'circle');
    const turns = dataset.data.map(() => 0);
    dataset.data = dataset.data.map((point, index) => {
      if (!(pb.numberOf(config, point, axis) <= 0)) return point;
      if (typeof point !== 'object') return null;
      shapes[index] = 'triangle';
      turns[index] = axis === 'y' ? 180 : -90;
      return {...point, [axis]: scale.min, label: `${point.label || dataset.label} (${point[axis]}: below the scale)`};
    });
    if (turns.some((turn) => turn !== 0)) {
      const keyShape = dataset.keyShape || shapes.find((_, i) => turns[i] === 0);
      Object.assign(dataset, {keyShape, pointStyle: shapes, pointRotation: turns});
    }
  }
};

pb.textWidth = (text) => {
  const context = pb.measuring ||= document.createElement('canvas').getContext('2d');
  context.font = `12px ${Chart.defaults.font.family}`;
  return context.measureText(text).width;
};

// Bars whose names do not fit beside each other lie, with their names at the left.
pb.layDown = (config, area) => {
  area.style.height = '';  // of bars that lay before the window became wider
  const {labels, datasets} = config.data;
  const widest = Math.max(0, ...labels.map(pb.textWidth));
  if ((widest + 10) * labels.length < area.clientWidth - 70) return;
  config.options.indexAxis = 'y';
  const scales = config.options.scales;
  [scales.x, scales.y] = [scales.y, scales.x];
  for (const dataset of datasets) dataset.data = dataset.data.map((point) => point !== null && typeof point === 'object' ? {...point, x: point.y, y: point.x} : point);
  const stacks = new Set(datasets.map((dataset) => dataset.stack || dataset)).size;
  area.style.height = `${70 + labels.length * Math.max(20, 8 + 6 * stacks)}px`;
  scales.y.ticks = {...scales.y.ticks, autoSkip: false};
};

// Each bar, point and line can be seen on the card: what is filled palely has a darker edge.
pb.edge = (dataset, type) => {
  const map = (value, change) => Array.isArray(value) ? value.map(change) : change(value);
  const isLine = (dataset.type || type) === 'line' || dataset.showLine;
  const colour = isLine ? dataset.borderColor : dataset.borderColor || dataset.backgroundColor;
  if (colour === undefined) return;
  dataset.borderColor = map(colour, pb.visible);
  if (!isLine) dataset.borderWidth ??= 1.2;
};

pb.withDefaults = (config) => {
  const options = config.options ||= {};
  options.plugins ||= {};
  options.plugins.pbmpi ||= {};
  options.scales ||= {};
  options.scales.x ||= {};
  options.scales.y ||= {};
  return config;
};

pb.setChartDefaults = () => {
  if (!pb.hasMarks) Chart.register(pb.marksPlugin);
  pb.hasMarks = true;
  Chart.defaults.animation = false;
  Chart.defaults.maintainAspectRatio = false;
  Chart.defaults.font.family = getComputedStyle(document.body).fontFamily;
  Chart.defaults.color = pb.themeColour('ink-soft');
  Chart.defaults.borderColor = pb.themeColour('line');
  Chart.defaults.scale.ticks.autoSkipPadding = 12;
  Chart.defaults.scale.ticks.maxRotation = 0;
};

// Draws the configuration of Chart.js that `make` returns into `area`, with a key below it; again when the look of the
// page changes. Calls `drawn` with each Chart.
pb.draw = (area, label, make, drawn = () => {}) => {
  let chart, canvas, key;
  const draw = () => {
    if (chart) chart.destroy();
    area.replaceChildren();
    pb.setChartDefaults();
    const config = pb.withDefaults(make());
    const bars = config.type === 'bar';
    if (bars && config.data.labels && !config.options.indexAxis) pb.layDown(config, area);
    for (const axis of ['x', 'y']) {
      const scale = config.options.scales[axis];
      if (scale.type === 'logarithmic') {
        pb.makeLogScale(scale, pb.valuesOnLogAxis(config, axis), bars ? 2 : 1.25);
        if (scale.type === 'logarithmic') pb.markOffScale(config, axis, scale);
      } else if (bars && axis === pb.valueAxis(config) && scale.max === undefined) {
        scale.grace = '4%';
      }
    }
    for (const dataset of config.data.datasets) {
      pb.edge(dataset, config.type);
      if (config.type === 'scatter') dataset.clip = 10;  // a point on the frame is drawn whole
    }
    const box = pb.element('div', {className: 'readout', hidden: true});
    box.setAttribute('role', 'status');
    const tooltip = config.options.plugins.tooltip || {};
    config.options.plugins.tooltip = {...tooltip, enabled: false, external: pb.showReadout(box),
                                      callbacks: {label: pb.pointText, ...tooltip.callbacks}};
    const withDatasets = config.options.plugins.legend?.display !== false;
    config.options.plugins.legend = {display: false};
    canvas = pb.element('canvas', {tabIndex: 0});
    canvas.setAttribute('role', 'img');
    canvas.setAttribute('aria-label', label);
    area.append(canvas, box);
    chart = new Chart(canvas, config);
    const {bands = [], key: more = []} = config.options.plugins.pbmpi;
    const ink = pb.themeColour('ink-soft');
    const shapes = more.map((entry) => ({label: entry.label, look: {fill: entry.colour || 'none', stroke: entry.colour ? pb.visible(entry.colour) : ink, ...entry}}));
    if (key) key.remove();
    key = pb.element('div', {});
    area.after(key);
    pb.addKey(chart, key, withDatasets, [...bands.map((band) => pb.bandEntry(chart, band)), ...shapes]);
    drawn(chart);
  };
  draw();
  pb.onLookChange(draw);
};
