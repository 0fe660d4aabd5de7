// Runs before a page's own scripts: keeps what text each canvas shows, where, and on what colour, since the elements do not
// say. A chart that is drawn anew begins with a cleared canvas.
(() => {
  const shown = window.canvasTexts = new Map();
  const context = CanvasRenderingContext2D.prototype;
  const {fillText, clearRect, getImageData} = context;
  const {getContext} = HTMLCanvasElement.prototype;

  // Each text reads a pixel back, which takes a drawing of the software renderer's GPU milliseconds.
  HTMLCanvasElement.prototype.getContext = function(kind, settings) {
    return getContext.call(this, kind, kind === '2d' ? {...settings, willReadFrequently: true} : settings);
  };

  context.clearRect = function(x, y, width, height) {
    if (width * height * this.getTransform().a ** 2 > 0.9 * this.canvas.width * this.canvas.height) shown.set(this.canvas, []);
    return clearRect.call(this, x, y, width, height);
  };

  const corners = (ctx, text, x, y) => {
    const size = ctx.measureText(text);
    const m = ctx.getTransform();
    const scale = ctx.canvas.width / ctx.canvas.clientWidth;
    const points = [];
    for (const dx of [-size.actualBoundingBoxLeft, size.actualBoundingBoxRight]) {
      for (const dy of [-size.actualBoundingBoxAscent, size.actualBoundingBoxDescent]) {
        points.push([(m.a * (x + dx) + m.c * (y + dy) + m.e) / scale, (m.b * (x + dx) + m.d * (y + dy) + m.f) / scale]);
      }
    }
    const [xs, ys] = [points.map((p) => p[0]), points.map((p) => p[1])];
    return {left: Math.min(...xs), right: Math.max(...xs), top: Math.min(...ys), bottom: Math.max(...ys), scale};
  };

  context.fillText = function(text, x, y, ...rest) {
    if (String(text).trim() !== '' && this.canvas.isConnected) {
      const box = corners(this, text, x, y);
      const pixel = getImageData.call(this, Math.round(box.scale * (box.left + box.right) / 2), Math.round(box.scale * box.top), 1, 1).data;
      if (!shown.has(this.canvas)) shown.set(this.canvas, []);
      shown.get(this.canvas).push({text: String(text), box, colour: this.fillStyle, behind: [...pixel], size: parseFloat(this.font.match(/[\d.]+px/)[0])});
    }
    return fillText.call(this, text, x, y, ...rest);
  };
})();
