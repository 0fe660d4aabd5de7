'use strict';
// The key of a chart as elements below it: text that wraps, and buttons that hide and show.

// Chart.js' names of shapes, as paths round (0, 0) within a radius of 5.
pb.shapePaths = {
  circle: 'M5 0A5 5 0 1 1 -5 0A5 5 0 1 1 5 0Z', triangle: 'M0 -5L4.6 3.2L-4.6 3.2Z', rect: 'M-3.7 -3.7H3.7V3.7H-3.7Z',
  rectRot: 'M0 -5L5 0L0 5L-5 0Z', star: 'M0 -5V5M-5 0H5M-3.6 -3.6L3.6 3.6M-3.6 3.6L3.6 -3.6', cross: 'M0 -5V5M-5 0H5',
  crossRot: 'M-3.6 -3.6L3.6 3.6M-3.6 3.6L3.6 -3.6', dash: 'M-5 0H5', down: 'M0 5L4.6 -3.2L-4.6 -3.2Z',
  up: 'M0 -5L4.6 3.2L-4.6 3.2Z', bar: 'M-6 -4H6V4H-6Z', ring: 'M5 0A5 5 0 1 1 -5 0A5 5 0 1 1 5 0Z',
};

// look: {shape, fill, stroke, dash, radius}.
pb.swatch = (look) => {
  const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
  const path = document.createElementNS('http://www.w3.org/2000/svg', 'path');
  const isLine = look.shape === 'line';
  path.setAttribute('d', isLine ? 'M-9 0H9' : pb.shapePaths[look.shape] || pb.shapePaths.circle);
  path.setAttribute('fill', isLine ? 'none' : look.fill || 'none');
  path.setAttribute('stroke', look.stroke || look.fill);
  path.setAttribute('stroke-width', isLine ? 2.5 : look.width || 1.5);
  if (look.dash) path.setAttribute('stroke-dasharray', look.dash.join(' '));
  if (look.radius) path.setAttribute('transform', `scale(${look.radius / 5})`);
  svg.setAttribute('viewBox', '-10 -8 20 16');
  svg.setAttribute('aria-hidden', 'true');
  svg.append(path);
  return svg;
};

pb.lookOf = (chart, dataset) => {
  const type = dataset.type || chart.config.type;
  const first = (value) => Array.isArray(value) ? value[0] : value;
  if (type === 'line' || dataset.showLine) return {shape: 'line', stroke: dataset.borderColor, dash: dataset.borderDash};
  if (type === 'bar') return {shape: 'bar', fill: dataset.backgroundColor, stroke: dataset.borderColor};
  const shape = dataset.keyShape || first(dataset.pointStyle) || 'circle';
  return {shape, fill: first(dataset.backgroundColor), stroke: first(dataset.borderColor), width: first(dataset.borderWidth)};
};

// A button an entry of the data; a line of text for what else is drawn: [{label, look}].
pb.addKey = (chart, parent, withDatasets, others) => {
  const list = pb.element('ul', {className: 'key'});
  chart.data.datasets.forEach((dataset, index) => {
    if (!withDatasets) return;
    const button = pb.element('button', {type: 'button'}, pb.swatch(pb.lookOf(chart, dataset)), dataset.label);
    const show = (shown) => {
      chart.setDatasetVisibility(index, shown);
      button.setAttribute('aria-pressed', shown);
      chart.update();
    };
    button.setAttribute('aria-pressed', chart.isDatasetVisible(index));
    button.addEventListener('click', () => show(!chart.isDatasetVisible(index)));
    list.append(pb.element('li', {}, button));
  });
  for (const {label, look} of others) list.append(pb.element('li', {}, pb.element('span', {}, pb.swatch(look), label)));
  if (list.children.length > 0) parent.append(list);
};
