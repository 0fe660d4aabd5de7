'use strict';
// A page of charts and tables, from JSON.

const element = (tag, properties, ...children) => {
  const node = Object.assign(document.createElement(tag), properties);
  node.append(...children);
  return node;
};

// Horizontal bands at values of the y axis, behind the data, with their labels at the right.
const bandsPlugin = {
  id: 'pbmpi',
  beforeDatasetsDraw(chart, _, options) {
    const {ctx, chartArea: area, scales} = chart;
    for (const band of options.bands || []) {
      const pixel = (value) => Math.min(area.bottom, Math.max(area.top, value > 0 || scales.y.type !== 'logarithmic' ?
          scales.y.getPixelForValue(value) : area.bottom));
      const top = pixel(band.to), bottom = pixel(band.from);
      ctx.save();
      ctx.fillStyle = band.colour;
      ctx.fillRect(area.left, top, area.width, Math.max(bottom - top, 1));
      ctx.fillStyle = '#3d4650';
      ctx.font = '11px ' + Chart.defaults.font.family;
      ctx.textAlign = band.align === 'left' ? 'left' : 'right';
      ctx.textBaseline = 'bottom';
      ctx.fillText(band.label, band.align === 'left' ? area.left + 6 : area.right - 6, Math.max(top - 2, area.top + 14));
      ctx.restore();
    }
  },
};

const addChart = (parent, chart) => {
  const canvas = element('canvas', {role: 'img'});
  canvas.setAttribute('aria-label', `${chart.title}: ${chart.text}`);
  parent.append(element('article', {className: 'chart'}, element('h3', {}, chart.title), element('p', {}, chart.text),
      element('div', {className: 'area'}, canvas)));
  const config = chart.config;
  config.options = config.options || {};
  config.options.plugins = config.options.plugins || {};
  // Points that carry a text of their own show it.
  config.options.plugins.tooltip = {callbacks: {label: (item) => (item.raw && item.raw.label) ||
      `${item.dataset.label}: ${item.formattedValue}`}};
  return new Chart(canvas, config);
};

const addTable = (parent, table) => {
  const row = (tag, cells) => element('tr', {}, ...cells.map((cell) => element(tag, {}, cell)));
  parent.append(element('div', {className: 'table'}, element('h3', {}, table.title), element('table', {},
      element('thead', {}, row('th', table.header)), element('tbody', {}, ...table.rows.map((cells) => row('td', cells))))));
};

Chart.register(bandsPlugin);
Chart.defaults.animation = false;
Chart.defaults.maintainAspectRatio = false;
Chart.defaults.font.family = getComputedStyle(document.body).fontFamily;
Chart.defaults.color = '#5b6775';
Chart.defaults.borderColor = '#e8ecf1';
Chart.defaults.plugins.legend.position = 'bottom';
Chart.defaults.plugins.legend.labels.boxWidth = 12;
Chart.defaults.plugins.legend.labels.boxHeight = 8;

for (const section of JSON.parse(document.getElementById('sections-data').textContent)) {
  const card = element('section', {className: 'card section'}, element('h2', {}, section.title));
  for (const text of section.text.split('\n\n')) {
    if (text) card.append(element('p', {}, text));
  }
  document.getElementById('sections').append(card);
  const grid = element('div', {className: 'chart-grid'});
  card.append(grid);
  for (const chart of section.charts) addChart(grid, chart);
  for (const table of section.tables) addTable(card, table);
}
document.body.dataset.ready = 'yes';
