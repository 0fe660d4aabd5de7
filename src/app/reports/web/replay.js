'use strict';
// The replay: which frame of which worlds is shown, playing, and the controls.

pb.speeds = [0.01, 0.02, 0.05, 0.1, 0.25, 0.5, 1, 2, 4];

// Columns of a grid of cells of this width / height: nearly square as a whole, with few cells left empty.
pb.gridColumns = (count, aspect) => {
  const wanted = Math.max(1, Math.sqrt(1.2 * count / aspect));
  let best = 1, least = Infinity;
  for (let columns = 1; columns <= count; ++columns) {
    const empty = (columns - count % columns) % columns;
    const cost = Math.abs(Math.log(columns / wanted)) + 2 * empty / count;
    if (cost < least) [best, least] = [columns, cost];
  }
  return best;
};

pb.Replay = class {
  constructor(replay, stage) {
    this.stage = stage;
    this.byId = (id) => document.getElementById(id);
    this.lastTick = 0;
    this.onFrame = () => {};
    stage.onRepaint = () => this.refresh();
    this.listen();
    this.data = replay;
    this.poses = new pb.Poses(replay);
    this.frame = 0;  // fractional while playing
    this.playing = false;
    this.followChosen = false;
    this.holdS = 0;
    this.dirty = true;
    this.fillControls();
    this.showPlaying();
    // All worlds at once say most about a run of many; one world is drawn as it is.
    this.setWorld(replay.numWorlds > 1 ? 'all' : 0);
  }

  fillControls() {
    this.byId('scrub').max = this.data.numFrames - 1;
    const duration = this.data.timeS[this.data.numFrames - 1] - this.data.timeS[0];
    // So slow that the run lasts some 5 s: a crash is over in a quarter of a second.
    this.speed = [...pb.speeds].reverse().find((speed) => duration / speed >= 5) || pb.speeds[0];
    this.speed = Math.min(1, this.speed);
    this.byId('speed').replaceChildren(...pb.speeds.map((speed) => pb.element('option', {
      value: speed, selected: speed === this.speed, textContent: speed < 1 ? `1/${Math.round(1 / speed)}×` : `${speed}×`,
    })));
    const option = (value, text) => pb.element('option', {value, textContent: text});
    this.byId('world').replaceChildren(option('all', `all ${this.data.numWorlds}`),
                              ...Array.from({length: this.data.numWorlds}, (_, world) => option(world, world)));
    this.byId('world-field').hidden = this.data.numWorlds < 2;
    this.byId('replay-note').textContent = this.data.note;
  }

  listen() {
    const on = (id, event, action) => this.byId(id).addEventListener(event, action);
    on('play', 'click', () => this.toggle());
    on('previous', 'click', () => this.step(-1));
    on('next', 'click', () => this.step(1));
    on('scrub', 'input', () => this.setFrame(Math.round(Number(this.byId('scrub').value))));
    on('speed', 'change', () => { this.speed = Number(this.byId('speed').value); });
    on('world', 'change', () => this.setWorld(this.byId('world').value));
    on('follow', 'change', () => this.setFollow(this.byId('follow').checked));
    on('reset-view', 'click', () => this.resetCamera());
    this.stage.controls.addEventListener('change', () => { this.dirty = true; });
    this.stage.controls.addEventListener('start', () => { this.ownView = true; });
    document.addEventListener('keydown', (event) => this.key(event));
    new ResizeObserver(() => this.resize()).observe(this.stage.canvas);
  }

  key(event) {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    // A focused button, select, fold-out, table or chart has its own use for these keys; the slider's arrows mean ours.
    const own = event.target.closest('button, select, summary, textarea, [role=region]');
    if (own && event.key !== 'r' || event.defaultPrevented || this.byId('replay').hidden) return;
    // The check box takes the space bar.
    if (event.target.type === 'checkbox' && event.key === ' ') return;
    const actions = {
      ' ': () => this.toggle(), ArrowLeft: () => this.step(-1), ArrowRight: () => this.step(1),
      Home: () => this.setFrame(0), End: () => this.setFrame(this.data.numFrames - 1), r: () => this.resetCamera(),
    };
    if (!actions[event.key]) return;
    event.preventDefault();
    actions[event.key]();
  }

  setWorld(world) {
    this.world = world === 'all' ? 'all' : Math.min(this.data.numWorlds - 1, Math.max(0, Math.trunc(Number(world)) || 0));
    this.byId('world').value = this.world;
    this.stage.showWorlds(this.world === 'all' ? this.gridOffsets() : new Map([[this.world, [0, 0]]]));
    this.showLegend();
    if (!this.followChosen) this.byId('follow').checked = this.stage.drifts();
    this.resetCamera();
    this.refresh();
  }

  // Worlds side by side in a square, each cell as wide as the widest world at its start, with room to move.
  gridOffsets() {
    const {numWorlds, numBodies, bodyWorld, position} = this.data;
    const bounds = Array.from({length: numWorlds}, () => [[Infinity, -Infinity], [Infinity, -Infinity]]);
    for (let body = 0; body < numBodies; ++body) {
      for (let k = 0; k < 2; ++k) {
        const range = bounds[bodyWorld[body]][k];
        range[0] = Math.min(range[0], position[3 * body + k]);
        range[1] = Math.max(range[1], position[3 * body + k]);
      }
    }
    const cell = [0, 1].map((k) => 3 + 1.1 * Math.max(...bounds.map((b) => b[k][1] - b[k][0]), 0));
    const columns = pb.gridColumns(numWorlds, cell[0] / cell[1]);
    return new Map(bounds.map((b, world) => [world, [
      (world % columns) * cell[0] - (b[0][0] + b[0][1]) / 2,
      -Math.floor(world / columns) * cell[1] - (b[1][0] + b[1][1]) / 2,
    ]]));
  }

  showLegend() {
    const kinds = this.data.kindNames.filter((kind) => this.stage.kinds.has(kind));
    this.byId('legend').replaceChildren(...kinds.map((kind) => pb.element('span', {},
        pb.element('i', {style: `background:${pb.kindColour[kind]}`}), kind)));
  }

  // The last recorded frame that has been reached.
  currentFrame() {
    return Math.floor(this.frame + 1e-9);
  }

  // The frame's number as plots count it: where not all frames were recorded, or the replay shows every k-th only, numbers
  // have gaps.
  numberOf(frame) {
    return this.data.number[frame];
  }

  // The shown frame that is nearest to a number.
  placeOf(number) {
    let nearest = 0;
    for (let frame = 1; frame < this.data.numFrames; ++frame) {
      if (Math.abs(this.numberOf(frame) - number) < Math.abs(this.numberOf(nearest) - number)) nearest = frame;
    }
    return nearest;
  }

  setFrame(frame) {
    this.frame = Math.min(this.data.numFrames - 1, Math.max(0, Number(frame) || 0));
    this.refresh();
  }

  step(by) {
    this.pause();
    this.setFrame(by < 0 && this.frame > this.currentFrame() ? this.currentFrame() : this.currentFrame() + by);
  }

  toggle() {
    if (this.playing) this.pause(); else this.play();
  }

  play() {
    if (this.frame >= this.data.numFrames - 1) this.setFrame(0);
    this.playing = true;
    this.lastTick = performance.now();
    this.holdS = 0;
    this.showPlaying();
  }

  pause() {
    this.playing = false;
    this.showPlaying();
  }

  showPlaying() {
    this.byId('play').classList.toggle('playing', this.playing);
    this.byId('play').setAttribute('aria-label', this.playing ? 'Pause' : 'Play');
  }

  // Goes on by `elapsed` seconds of the viewer's time; starts again 0.8 s after the end.
  advance(elapsed) {
    const end = this.data.timeS[this.data.numFrames - 1];
    if (this.frame >= this.data.numFrames - 1) {
      this.holdS += elapsed;
      if (this.holdS > 0.8) this.setFrame(0);
      return;
    }
    this.holdS = 0;
    const timeS = this.poses.timeAt(this.frame) + elapsed * this.speed;
    this.setFrame(timeS >= end ? this.data.numFrames - 1 : this.poses.frameAt(timeS));
  }

  tick(now) {
    if (this.playing) {
      this.advance(Math.min(0.25, (now - this.lastTick) / 1000));
      this.lastTick = now;
    }
    if (this.dirty) this.draw();
  }

  draw() {
    this.dirty = false;
    this.stage.render();
  }

  // New poses, and the words that go with them.
  refresh() {
    this.poses.interpolate(this.frame);
    this.stage.setPoses(this.poses);
    this.followBodies();
    const frame = this.currentFrame();
    const time = this.poses.timeAt(this.frame);
    const digits = this.data.timeS[this.data.numFrames - 1] < 100 ? 3 : 1;
    this.byId('scrub').value = this.frame;
    this.byId('frame-label').textContent =
        `frame ${this.numberOf(frame)} of ${this.numberOf(this.data.numFrames - 1)} · step ${this.data.step[frame]} · ${time.toFixed(digits)} s`;
    this.byId('view-label').textContent = `${this.world === 'all' ? `${this.data.numWorlds} worlds` :
        this.data.numWorlds > 1 ? `world ${this.world}` : pb.about.scene} · t = ${time.toFixed(digits)} s`;
    this.dirty = true;
    this.onFrame(this.numberOf(frame));
  }

  setFollow(follow) {
    this.byId('follow').checked = follow;
    this.followChosen = true;
    this.resetCamera();
  }

  // Moves the camera with the middle of the bodies since the last picture.
  followBodies() {
    if (!this.byId('follow').checked) return;
    const middle = this.stage.middle(this.poses);
    if (this.followed) this.stage.moveCamera(middle.clone().sub(this.followed));
    this.followed = middle;
  }

  // With "follow": looks at the bodies as they are now, else at all places where they come.
  resetCamera() {
    this.stage.resize();
    this.stage.resetCamera(this.byId('follow').checked ? this.poses : null);
    this.followed = null;
    this.followBodies();
    this.ownView = false;
    this.dirty = true;
  }

  setCamera(position, target) {
    this.stage.setCamera(position, target);
    this.ownView = true;
    this.dirty = true;
  }

  // A view that nobody chose fits the new shape of the picture.
  resize() {
    if (this.ownView) this.stage.resize(); else this.resetCamera();
    this.draw();
  }
};
