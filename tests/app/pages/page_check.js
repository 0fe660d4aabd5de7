// Returns what is wrong with the page as it lies before a reader: ["KIND: what and where", ...]. Kinds: overlap (text on other
// text), box (text beyond the box of an element), view (text beyond the window), contrast (of text, or of what a chart
// draws), keyboard (what only a mouse reaches), bar (beyond its frame), decade (of an axis, without its label), scale (a
// line off the scale that the key does not tell).
(() => {
  const problems = [];
  const report = (kind, text) => problems.push(`${kind}: ${text}`);
  const short = (text) => JSON.stringify(text.trim().slice(0, 50));
  const shownStyle = new Map();
  const styleOf = (element) => {
    if (!shownStyle.has(element)) shownStyle.set(element, getComputedStyle(element));
    return shownStyle.get(element);
  };

  // Colours, as WCAG 2.1 weighs them.
  const channels = (colour) => {
    const canvas = channels.canvas ||= Object.assign(document.createElement('canvas'), {width: 1, height: 1});
    const context = channels.context ||= canvas.getContext('2d', {willReadFrequently: true});
    context.clearRect(0, 0, 1, 1);
    context.fillStyle = colour;
    context.fillRect(0, 0, 1, 1);
    const [r, g, b, a] = context.getImageData(0, 0, 1, 1).data;
    return [r, g, b, a / 255];
  };
  const over = ([r, g, b, a], back) => [r, g, b].map((c, k) => a * c + (1 - a) * back[k]);
  const luminance = (rgb) => rgb.map((c) => c / 255 <= 0.03928 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4)
      .reduce((sum, c, k) => sum + c * [0.2126, 0.7152, 0.0722][k], 0);
  const contrast = (a, b) => (Math.max(luminance(a), luminance(b)) + 0.05) / (Math.min(luminance(a), luminance(b)) + 0.05);
  const backOf = (element) => {
    const layers = [];
    for (let node = element; node; node = node.parentElement) {
      const layer = channels(styleOf(node).backgroundColor);
      if (layer[3] > 0) layers.push(layer);
      if (layer[3] === 1) break;
    }
    const base = matchMedia('(prefers-color-scheme: dark)').matches ? [18, 18, 18] : [255, 255, 255];
    return layers.reduceRight((back, layer) => over(layer, back), base);
  };

  // Lines of text of the elements: {text, element, left, right, top, bottom}, cut to what scrolls.
  const scrolls = (style, axis) => ['auto', 'scroll'].includes(style[`overflow${axis}`]);
  const lines = [];
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (walker.nextNode()) {
    const node = walker.currentNode, element = node.parentElement;
    if (node.data.trim() === '' || element.closest('script, style, .readout')) continue;
    if (!element.checkVisibility({checkOpacity: true, checkVisibilityCSS: true})) continue;
    const range = document.createRange();
    range.selectNodeContents(node);
    for (const box of range.getClientRects()) {
      if (box.width > 1 && box.height > 1) lines.push({text: node.data, element, left: box.left, right: box.right, top: box.top, bottom: box.bottom});
    }
  }

  // Boxes round each line, from the inside out, until one that scrolls hides what is outside.
  const inBoxes = (line) => {
    for (let box = line.element; box && box !== document.body; box = box.parentElement) {
      const style = styleOf(box);
      if (style.display === 'inline' || style.display === 'contents') continue;
      const edge = box.getBoundingClientRect();
      if (scrolls(style, 'X') || scrolls(style, 'Y')) {
        line.left = Math.max(line.left, edge.left);
        line.right = Math.min(line.right, edge.right);
        line.top = Math.max(line.top, edge.top);
        line.bottom = Math.min(line.bottom, edge.bottom);
        if (line.right - line.left < 1 || line.bottom - line.top < 1) return false;
        continue;
      }
      // The box of a font is higher than the line that it stands in, by a few pixels.
      if (line.left < edge.left - 1 || line.right > edge.right + 1 || line.top < edge.top - 5 || line.bottom > edge.bottom + 5) {
        report('box', `${short(line.text)} leaves <${box.tagName.toLowerCase()} class="${box.className}">`);
        return true;
      }
    }
    return true;
  };
  const visible = lines.filter(inBoxes);

  for (const line of visible) {
    const style = styleOf(line.element), size = parseFloat(style.fontSize);
    const back = backOf(line.element);
    const found = contrast(over(channels(style.color), back), back);
    const wanted = size >= 24 || (size >= 18.66 && style.fontWeight >= 700) ? 3 : 4.5;
    if (found < wanted) report('contrast', `${short(line.text)} has ${found.toFixed(2)}, wants ${wanted}`);
  }

  // Text in charts.
  for (const [canvas, texts] of window.canvasTexts || []) {
    if (!canvas.isConnected || !canvas.checkVisibility()) continue;
    const place = canvas.getBoundingClientRect(), behind = backOf(canvas);
    for (const {text, box, colour, behind: pixel} of texts) {
      if (box.left < -1 || box.right > place.width + 1 || box.top < -1 || box.bottom > place.height + 1) {
        report('box', `${short(text)} leaves its chart ${short(canvas.getAttribute('aria-label') || '')}`);
      }
      const back = over([...pixel.slice(0, 3), pixel[3] / 255], behind);
      const found = contrast(over(channels(colour), back), back);
      if (found < 4.5) report('contrast', `${short(text)} in a chart has ${found.toFixed(2)}, wants 4.5`);
      visible.push({text, element: canvas, left: place.left + box.left, right: place.left + box.right,
        top: place.top + box.top, bottom: place.top + box.bottom, exact: true});
    }
  }

  const width = document.documentElement.clientWidth;
  for (const line of visible) {
    if (line.left < -0.5 || line.right > width + 0.5) report('view', `${short(line.text)} reaches from ${line.left.toFixed(0)} to ${line.right.toFixed(0)} of ${width}`);
  }
  if (document.documentElement.scrollWidth > width) report('view', `the page is ${document.documentElement.scrollWidth} wide, the window ${width}`);

  // A font's box is taken without its upper and lower sixth, in which hardly any letter has ink.
  const ink = visible.map((line) => {
    const margin = line.exact ? 0 : (line.bottom - line.top) / 6;
    return {...line, top: line.top + margin, bottom: line.bottom - margin};
  }).sort((a, b) => a.top - b.top);
  ink.forEach((a, index) => {
    for (let k = index + 1; k < ink.length && ink[k].top < a.bottom - 1; ++k) {
      const b = ink[k];
      if (Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1) report('overlap', `${short(a.text)} and ${short(b.text)}`);
    }
  });

  for (const element of document.querySelectorAll('body *')) {
    const style = styleOf(element);
    const wide = scrolls(style, 'X') && element.scrollWidth > element.clientWidth + 1, high = scrolls(style, 'Y') && element.scrollHeight > element.clientHeight + 1;
    if ((wide || high) && element.checkVisibility() && element.tabIndex < 0)
      report('keyboard', `<${element.tagName.toLowerCase()} class="${element.className}"> scrolls, but has no focus`);
  }

  const charts = typeof Chart === 'undefined' ? [] : Object.values(Chart.instances);
  for (const chart of charts) {
    const name = short(chart.canvas.getAttribute('aria-label') || '');
    if (chart.canvas.tabIndex < 0) report('keyboard', `chart ${name} has no focus`);
    const {left, right, top, bottom} = chart.chartArea, back = backOf(chart.canvas);
    chart.data.datasets.forEach((dataset, index) => {
      const meta = chart.getDatasetMeta(index);
      const seen = [dataset.borderColor, ...(meta.type === 'line' || dataset.showLine ? [] : [dataset.backgroundColor])].flat().filter(Boolean);
      if (Math.max(0, ...seen.map((colour) => contrast(over(channels(colour), back), back))) < 3)
        report('contrast', `${short(dataset.label)} in chart ${name} is hardly seen`);
      if (meta.type !== 'bar' || meta.hidden) return;
      for (const bar of meta.data) {
        const lying = chart.options.indexAxis === 'y';
        const [low, high] = lying ? [bar.x, bar.base] : [bar.y, bar.base];
        const [from, to] = lying ? [left, right] : [top, bottom];
        if ([low, high].some((end) => isFinite(end) && (end < from - 1 || end > to + 1))) report('bar', `of ${short(dataset.label)} leaves the frame of chart ${name}`);
      }
    });
    for (const scale of Object.values(chart.scales)) {
      if (scale.type !== 'logarithmic') continue;
      const labelled = scale.ticks.filter((tick) => tick.label !== '' && tick.label !== undefined).map((tick) => tick.value);
      for (let exponent = Math.ceil(Math.log10(scale.min) - 1e-9); exponent <= Math.log10(scale.max) + 1e-9; ++exponent) {
        if (!labelled.some((value) => Math.abs(value / 10 ** exponent - 1) < 1e-6)) report('decade', `10^${exponent} of axis ${scale.id} of chart ${name} has no label`);
      }
    }
    const key = [...chart.canvas.closest('.area').nextElementSibling?.querySelectorAll('li') || []].map((entry) => entry.textContent);
    for (const band of chart.options.plugins.pbmpi?.bands || []) {
      const axis = chart.options.indexAxis === 'y' ? {x: 'y', y: 'x'}[band.axis || 'y'] : band.axis || 'y';
      const scale = chart.scales[axis];
      const off = band.to < scale.min ? 'below' : band.from > scale.max ? 'above' : '';
      if (off && !key.some((entry) => entry.startsWith(band.label) && entry.endsWith(`${off} the scale`)))
        report('scale', `${short(band.label)} of chart ${name} lies ${off} it, and the key does not say so`);
    }
  }
  return problems;
})();
