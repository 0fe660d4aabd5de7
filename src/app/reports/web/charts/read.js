'use strict';
// Reading a chart off: a box of text that wraps, for the mouse and for the keyboard.

// What a point says of itself, or its set and value.
pb.pointText = (item) => (item.raw && item.raw.label) || `${item.dataset.label}: ${item.formattedValue}`;

// Chart.js' "external" tooltip: its text in a box over the chart.
pb.showReadout = (box) => ({chart, tooltip}) => {
  box.hidden = tooltip.opacity === 0;
  if (box.hidden) return;
  const lines = [...(tooltip.title || []), ...(tooltip.body || []).flatMap((part) => part.lines)];
  box.replaceChildren(...lines.map((line) => pb.element('div', {}, line)));
  const left = tooltip.caretX - box.offsetWidth / 2, above = tooltip.caretY - box.offsetHeight - 12;
  box.style.left = `${Math.max(0, Math.min(chart.width - box.offsetWidth, left))}px`;
  box.style.top = `${above >= 0 ? above : Math.min(chart.height - box.offsetHeight, tooltip.caretY + 12)}px`;
};

// Visible points from left to right (of horizontal bars from top to bottom): [{datasetIndex, index}].
pb.pointsInOrder = (chart) => {
  const axis = chart.options.indexAxis === 'y' ? 'y' : 'x';
  const points = [];
  chart.data.datasets.forEach((dataset, datasetIndex) => {
    if (!chart.isDatasetVisible(datasetIndex) || dataset.unread) return;
    chart.getDatasetMeta(datasetIndex).data.forEach((element, index) => {
      if (!element.skip && isFinite(element.x + element.y)) points.push({datasetIndex, index, at: element[axis]});
    });
  });
  return points.sort((a, b) => a.at - b.at || a.datasetIndex - b.datasetIndex);
};

pb.activate = (chart, points) => {
  const at = points.length > 0 ? chart.getDatasetMeta(points[0].datasetIndex).data[points[0].index].tooltipPosition() : {x: 0, y: 0};
  chart.setActiveElements(points);
  chart.tooltip.setActiveElements(points, at);
  chart.update('none');
};

// Arrows go from point to point, Home and End to the ends, Escape away.
pb.readByKeyboard = (chart) => {
  let place = -1;
  chart.canvas.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const points = pb.pointsInOrder(chart);
    const to = {ArrowRight: place + 1, ArrowDown: place + 1, ArrowLeft: place - 1, ArrowUp: place - 1, Home: 0, End: points.length - 1, Escape: -1}[event.key];
    if (to === undefined || points.length === 0) return;
    event.preventDefault();
    place = event.key === 'Escape' ? -1 : Math.max(0, Math.min(points.length - 1, to));
    pb.activate(chart, place < 0 ? [] : [points[place]]);
  });
  chart.canvas.addEventListener('blur', () => { place = -1; pb.activate(chart, []); });
};
