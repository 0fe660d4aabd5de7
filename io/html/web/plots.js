'use strict';
// The plots, with Chart.js.

pb.plotColour = {
  line: '#0072b2', fill: 'rgba(0, 114, 178, .16)', budget: '#d55e00', warmup: 'rgba(120, 130, 142, .14)',
  // The phases of a step, then what is not the simulation itself.
  collide: '#0072b2', islands: '#56b4e9', rows: '#009e73', solve: '#e69f00', integrate: '#f0e442',
  cross_space: '#cc79a7', gather: '#7a8490', wait: '#c3ccd5', output: '#3d4650',
};

// A grey band behind the warm-up frames, which the summary leaves out.
pb.warmupBand = {
  id: 'warmupBand',
  afterDatasetsDraw(chart, _, options) {
    if (!(options.bins > 0)) return;
    const {ctx, chartArea: area, scales} = chart;
    const last = chart.data.labels.length - 1;
    const edge = options.bins > last ? area.right :
        (scales.x.getPixelForValue(options.bins - 1) + scales.x.getPixelForValue(options.bins)) / 2;
    ctx.save();
    ctx.fillStyle = pb.plotColour.warmup;
    ctx.fillRect(area.left, area.top, edge - area.left, area.bottom - area.top);
    ctx.fillStyle = '#5b6775';
    ctx.font = '11px ' + Chart.defaults.font.family;
    ctx.textBaseline = 'bottom';
    if (edge - area.left > 60) ctx.fillText('warm-up', area.left + 6, area.bottom - 4);
    ctx.restore();
  },
};

pb.plotCard = (title, text) => {
  const canvas = pb.element('canvas', {role: 'img'});
  canvas.setAttribute('aria-label', `${title}: ${text}`);
  document.getElementById('plots').append(pb.element('article', {className: 'plot'},
      pb.element('h2', {}, title), pb.element('p', {}, text), pb.element('div', {className: 'area'}, canvas)));
  return canvas;
};

pb.lineSet = (label, data, colour, more) => ({
  label, data, borderColor: colour, backgroundColor: colour, borderWidth: 2, tension: 0,
  pointRadius: data.length > 60 ? 0 : 2.5, ...more,
});

pb.framePlot = (plots, title, text, datasets, y) => {
  const labels = Array.from({length: plots.wall_ms.length}, (_, bin) => bin * plots.per_bin);
  return new Chart(pb.plotCard(title, text), {
    type: 'line',
    data: {labels, datasets},
    options: {
      interaction: {mode: 'index', intersect: false},
      plugins: {
        legend: {display: datasets.length > 1, position: 'bottom'},
        warmupBand: {bins: Math.round(plots.num_warmup / plots.per_bin)},
        tooltip: {callbacks: {title: (items) => `frame ${items[0].label}`}},
      },
      scales: {
        x: {title: {display: true, text: 'frame'}, ticks: {maxRotation: 0, autoSkipPadding: 16}, grid: {display: false}},
        y: {beginAtZero: true, ...y},
      },
    },
  });
};

pb.plotFrameTime = (plots) => {
  const budget = plots.wall_ms.map(() => plots.budget_ms);
  const sorted = [...plots.wall_ms].sort((a, b) => a - b);
  // A linear axis hides the ordinary frames under one spike.
  const logarithmic = sorted[sorted.length - 1] > 8 * sorted[Math.floor(sorted.length / 2)];
  const bins = plots.per_bin > 1 ? `; each point is the slowest of ${plots.per_bin} frames` : '';
  const text = `Wall-clock time of each frame [ms]${logarithmic ? ', logarithmic' : ''}${bins}.`;
  pb.framePlot(plots, 'Frame time', text, [
    pb.lineSet('frame time', plots.wall_ms, pb.plotColour.line),
    pb.lineSet(`budget ${plots.budget_ms.toFixed(2)} ms`, budget, pb.plotColour.budget,
               {borderDash: [6, 4], pointRadius: 0, borderWidth: 1.5}),
  ], {type: logarithmic ? 'logarithmic' : 'linear', beginAtZero: !logarithmic, title: {display: true, text: 'ms'}});
};

pb.plotPhases = (plots) => {
  const labels = Array.from({length: plots.num_ranks}, (_, rank) => `rank ${rank}`);
  const datasets = plots.phases.map((phase) => ({
    label: phase.name.replace('_', ' '), data: phase.mean_ms, backgroundColor: pb.plotColour[phase.name],
    maxBarThickness: 34,
  }));
  new Chart(pb.plotCard('Phases', 'Where each rank\u2019s time goes: mean of the measured frames [ms].'), {
    type: 'bar',
    data: {labels, datasets},
    options: {
      indexAxis: plots.num_ranks <= 12 ? 'y' : 'x',
      interaction: {mode: 'nearest', intersect: true},
      plugins: {
        legend: {position: 'bottom'},
        tooltip: {callbacks: {label: (item) => `${item.dataset.label}: ${item.raw.toPrecision(3)} ms`,
                              title: (items) => `${items[0].label} on ${plots.hosts[items[0].dataIndex] || '?'}`}},
      },
      scales: {
        x: {stacked: true, title: {display: plots.num_ranks <= 12, text: 'ms'}},
        y: {stacked: true, title: {display: plots.num_ranks > 12, text: 'ms'}},
      },
    },
  });
};

pb.plotCounts = (plots, name, band) => {
  if (!band) return;
  const title = name[0].toUpperCase() + name.slice(1);
  const sum = pb.lineSet(name, band.sum, pb.plotColour.line, {fill: true, backgroundColor: pb.plotColour.fill});
  const y = {ticks: {precision: 0}};
  pb.framePlot(plots, title, plots.num_worlds > 1 ? `In all ${plots.num_worlds} worlds together, at the end of each frame.` :
                                                    'At the end of each frame.', [sum], y);
  if (plots.num_worlds < 2) return;
  pb.framePlot(plots, `${title} per world`, 'The world with most, the mean world, the world with fewest.', [
    pb.lineSet('most', band.max, '#7fb4d6', {borderWidth: 1.5, pointRadius: 0, fill: '+2', backgroundColor: pb.plotColour.fill}),
    pb.lineSet('mean', band.mean, pb.plotColour.line),
    pb.lineSet('fewest', band.min, '#7fb4d6', {borderWidth: 1.5, pointRadius: 0}),
  ], y);
};

pb.showPlots = () => {
  const plots = pb.json('plots-data');
  Chart.register(pb.warmupBand);
  Chart.defaults.animation = false;
  Chart.defaults.maintainAspectRatio = false;
  Chart.defaults.font.family = getComputedStyle(document.body).fontFamily;
  Chart.defaults.color = '#5b6775';
  Chart.defaults.borderColor = '#e8ecf1';
  Chart.defaults.plugins.legend.labels.boxWidth = 12;
  Chart.defaults.plugins.legend.labels.boxHeight = 8;
  pb.plotFrameTime(plots);
  pb.plotPhases(plots);
  pb.plotCounts(plots, 'islands', plots.islands);
  pb.plotCounts(plots, 'contacts', plots.contacts);
};
