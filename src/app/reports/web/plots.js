'use strict';
// The plots of a run. Frame f is the same in all of them and in the replay: the f-th since the start of the simulation,
// whose end the replay shows as frame f.

pb.plotColour = {
  line: '#0072b2', fill: 'rgba(0, 114, 178, .16)', other: '#d55e00', third: '#009e73',
  // The phases of a step, then what is not the simulation itself.
  collide: '#0072b2', islands: '#56b4e9', rows: '#009e73', solve: '#e69f00', integrate: '#f0e442',
  cross_space: '#cc79a7', gather: '#7a8490', wait: '#c3ccd5', output: '#3d4650',
};

pb.plotArea = (title, text) => {
  const area = pb.element('div', {className: 'area'});
  document.getElementById('plots').append(pb.element('article', {className: 'plot'}, pb.element('h2', {}, title), pb.element('p', {}, text), area));
  return area;
};

// The frames of the cursor and of clicks, in all plots over frames.
pb.framePlots = {
  charts: new Set(),
  frame: 0,
  onChoose: () => {},
  setCursor(frame) {
    if (frame === this.frame) return;
    this.frame = frame;
    for (const chart of this.charts) {
      if (!chart.ctx) { this.charts.delete(chart); continue; }  // destroyed, and drawn anew in another colour
      chart.cursor = frame;
      chart.draw();
      if (document.activeElement === chart.canvas) this.readOff(chart);
    }
  },
  // What the focused plot shows at the frame of the replay.
  readOff(chart) {
    const bins = chart.data.datasets[0].data;
    let index = -1;
    while (index + 1 < bins.length && bins[index + 1].x <= this.frame) ++index;
    pb.activate(chart, index < 0 ? [] : chart.data.datasets.map((_, datasetIndex) => ({datasetIndex, index})));
  },
  add(chart) {
    chart.cursor = this.frame;
    this.charts.add(chart);
    chart.canvas.addEventListener('focus', () => this.readOff(chart));
    chart.canvas.addEventListener('blur', () => pb.activate(chart, []));
    chart.draw();
  },
};

// Points at the frames of `values`, which are those of bins.
pb.overFrames = (plots, values) => values.map((y, bin) => ({x: plots.first_frame + 1 + bin * plots.per_bin, y}));

pb.lineSet = (plots, label, values, colour, more) => ({
  label, data: pb.overFrames(plots, values), borderColor: colour, backgroundColor: colour, borderWidth: 2, tension: 0,
  pointRadius: values.length > 60 ? 0 : 2.5, ...more,
});

pb.warmupBand = (plots) => ({from: plots.first_frame, to: plots.first_frame + plots.num_warmup + 0.5, axis: 'x', label: 'warm-up',
                             colour: 'rgba(120, 130, 142, .22)', showValue: false});

pb.framePlot = (plots, title, text, datasets, {y = {}, bands = []} = {}) => {
  const last = plots.first_frame + Math.max(1, plots.num_frames);
  const number = (item) => `${item.dataset.label}: ${item.raw.y === null ? 'not a number' : pb.shortNumber(item.raw.y)}`;
  pb.draw(pb.plotArea(title, text), `${title}: ${text}`, () => ({
    type: 'line',
    data: {datasets: structuredClone(datasets)},
    options: {
      interaction: {mode: 'index', intersect: false},
      onClick: (event, _, chart) => pb.framePlots.onChoose(chart.scales.x.getValueForPixel(event.x)),
      plugins: {
        legend: {display: datasets.length > 1},
        pbmpi: {cursor: true, bands: [...(plots.num_warmup > 0 ? [pb.warmupBand(plots)] : []), ...bands]},
        tooltip: {callbacks: {
          title: (items) => `frame ${items[0].raw.x}${plots.per_bin > 1 ? ` to ${Math.min(last, items[0].raw.x + plots.per_bin - 1)}` : ''}`,
          label: number}},
      },
      scales: {
        x: {type: 'linear', min: plots.first_frame, max: last, title: {display: true, text: 'frame'},
            ticks: {precision: 0, autoSkipPadding: 16, includeBounds: false}, grid: {display: false}},
        y: {beginAtZero: true, ...y},
      },
    },
  }), (chart) => pb.framePlots.add(chart));
};

pb.plotFrameTime = (plots) => {
  const sorted = [...plots.wall_ms].sort((a, b) => a - b);
  // A linear axis hides the ordinary frames under one spike.
  const logarithmic = sorted[sorted.length - 1] > 8 * sorted[Math.floor(sorted.length / 2)];
  const bins = plots.per_bin > 1 ? `; each point is the slowest of ${plots.per_bin} frames` : '';
  const text = `Wall-clock time of each frame [ms]${logarithmic ? ', logarithmic' : ''}${bins}.`;
  const budget = {from: plots.budget_ms, to: plots.budget_ms, label: 'budget [ms]', colour: pb.plotColour.other, dash: [6, 4]};
  const y = logarithmic ? {type: 'logarithmic', beginAtZero: false} : {suggestedMax: budget.to <= 4 * sorted[sorted.length - 1] ? 1.1 * budget.to : 0};
  pb.framePlot(plots, 'Frame time', text, [pb.lineSet(plots, 'frame time', plots.wall_ms, pb.plotColour.line)],
               {y: {...y, title: {display: true, text: 'ms'}}, bands: [budget]});
};

pb.plotPhases = (plots) => {
  const lying = plots.num_ranks <= 12;
  const labels = Array.from({length: plots.num_ranks}, (_, rank) => `rank ${rank}`);
  const axis = {stacked: true, title: {display: true, text: 'ms'}};
  const text = 'Where each rank\u2019s time goes: mean of the measured frames [ms].';
  pb.draw(pb.plotArea('Phases', text), `Phases: ${text}`, () => ({
    type: 'bar',
    data: {labels, datasets: plots.phases.map((phase) => ({
      label: phase.name.replace('_', ' '), data: [...phase.mean_ms], backgroundColor: pb.plotColour[phase.name], maxBarThickness: 34,
    }))},
    options: {
      indexAxis: lying ? 'y' : 'x',
      interaction: {mode: 'nearest', intersect: true},
      plugins: {tooltip: {callbacks: {label: (item) => `${item.dataset.label}: ${item.raw.toPrecision(3)} ms`,
                                      title: (items) => `${items[0].label} on ${plots.hosts[items[0].dataIndex] || '?'}`}}},
      scales: lying ? {x: axis, y: {stacked: true}} : {x: {stacked: true}, y: axis},
    },
  }), pb.readByKeyboard);
};

pb.worldsText = (plots, text) => plots.num_worlds > 1 ? `${text}: the world with most, the mean world, the world with least.` : `${text}.`;

// One curve of a single world; of several worlds that with most, the mean, and that with least.
pb.plotBand = (plots, title, text, band, y) => {
  const one = [pb.lineSet(plots, title.toLowerCase(), band.max, pb.plotColour.line)];
  const several = [
    pb.lineSet(plots, 'most', band.max, '#56b4e9', {borderWidth: 1.5, pointRadius: 0, borderDash: [6, 3]}),
    pb.lineSet(plots, 'mean', band.mean, pb.plotColour.line),
    pb.lineSet(plots, 'least', band.min, '#56b4e9', {borderWidth: 1.5, pointRadius: 0, borderDash: [2, 3]}),
  ];
  pb.framePlot(plots, title, pb.worldsText(plots, text), plots.num_worlds > 1 ? several : one, {y});
};

pb.plotCounts = (plots, name, band) => {
  if (!band) return;
  const title = name[0].toUpperCase() + name.slice(1);
  const y = {ticks: {precision: 0}};
  const sum = pb.lineSet(plots, name, band.sum, pb.plotColour.line, {fill: true, backgroundColor: pb.plotColour.fill});
  pb.framePlot(plots, title, plots.num_worlds > 1 ? `In all ${plots.num_worlds} worlds together, at the end of each frame.` :
                                                    'At the end of each frame.', [sum], {y});
  if (plots.num_worlds > 1) pb.plotBand(plots, `${title} per world`, 'At the end of each frame', band, y);
};

// Energy, momentum, gap and penetration: what a simulation should keep, and where it does not.
pb.plotInvariants = (plots) => {
  const titled = (text, more) => ({title: {display: true, text}, ...more});
  if (plots.energy) pb.plotBand(plots, 'Energy', 'Kinetic and potential energy of a world [J], at the end of each frame', plots.energy,
      titled('J', {beginAtZero: false}));
  if (plots.linear_momentum) {
    pb.plotBand(plots, 'Momentum', 'Length of the linear momentum of a world [kg m/s], at the end of each frame', plots.linear_momentum, titled('kg m/s'));
  }
  if (plots.angular_momentum) {
    pb.plotBand(plots, 'Angular momentum', 'Length of the angular momentum of a world about the origin [kg m\u00b2/s], at the end of each frame',
                plots.angular_momentum, titled('kg m\u00b2/s'));
  }
  if (plots.joint_gap_mm) pb.plotBand(plots, 'Joint gap', 'Largest gap of a joint of a world [mm], at the end of each frame', plots.joint_gap_mm,
      titled('mm', {suggestedMax: 1e-3}));
  if (plots.max_penetration_mm) {
    pb.plotBand(plots, 'Penetration', 'Deepest contact of a world [mm], in the last step of each frame', plots.max_penetration_mm, titled('mm', {suggestedMax: 1e-3}));
  }
};

pb.showPlots = () => {
  const plots = pb.json('plots-data');
  pb.plotFrameTime(plots);
  pb.plotPhases(plots);
  pb.plotCounts(plots, 'islands', plots.islands);
  pb.plotCounts(plots, 'contacts', plots.contacts);
  pb.plotInvariants(plots);
};
