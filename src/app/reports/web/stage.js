'use strict';
// The 3D scene: lights, ground, bodies, camera. Knows nothing of time but the poses it is given.

pb.Stage = class {
  constructor(canvas, replay) {
    this.canvas = canvas;
    this.replay = replay;
    this.renderer = new THREE.WebGLRenderer({canvas, antialias: true});
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = THREE.PCFSoftShadowMap;
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(38, 1, 0.05, 4000);
    this.camera.up.set(0, 0, 1);
    this.controls = new THREE.OrbitControls(this.camera, canvas);
    this.controls.enableKeys = false;  // the arrows step frames
    this.controls.maxPolarAngle = 0.97 * Math.PI / 2 + 0.04;
    this.scene.add(new THREE.HemisphereLight('#ffffff', '#e4e2de', 0.66));
    this.sun = new THREE.DirectionalLight('#fffaf2', 0.48);
    this.sun.castShadow = true;
    this.scene.add(this.sun, this.sun.target);
    this.groups = [];
    this.planes = [];
    pb.onLookChange(() => { if (this.offsets) { this.clear(); this.showWorlds(this.offsets); this.onRepaint(); } });
  }

  onRepaint() {}

  // Draws these worlds, each moved by its offset [x, y] m in the picture.
  showWorlds(offsets) {
    this.clear();
    this.offsets = offsets;
    const instances = pb.instancesOf(this.replay, new Set(offsets.keys()));
    const solids = pb.unitSolids(instances.length);
    this.replay.hulls.forEach((corners, i) => { solids[`hull${i}`] = pb.hullSolid(corners); });
    const sorted = new Map();
    for (const instance of instances) {
      const key = `${instance.kind} ${instance.solid}`;
      if (!sorted.has(key)) sorted.set(key, []);
      sorted.get(key).push(instance);
    }
    for (const members of sorted.values()) this.groups.push(this.makeGroup(members, solids));
    this.points = this.actionPoints();
    this.box = this.actionBox();
    this.away = this.viewDirection();
    this.addPlanes();
    this.placeSun(this.box);
    this.kinds = new Set(instances.map((instance) => instance.kind));
  }

  makeGroup(members, solids) {
    const geometry = solids[members[0].solid].clone();
    geometry.setAttribute('shade',
                          new THREE.InstancedBufferAttribute(new Float32Array(members.map((m) => m.shade)), 1));
    const mesh = new THREE.InstancedMesh(geometry, pb.shadedMaterial(pb.kindColour[members[0].kind]), members.length);
    mesh.castShadow = mesh.receiveShadow = true;
    mesh.frustumCulled = false;  // its bounds are those of one unit solid
    this.scene.add(mesh);
    return {mesh, members};
  }

  clear() {
    for (const {mesh} of this.groups) {
      this.scene.remove(mesh);
      mesh.geometry.dispose();
      mesh.material.dispose();
    }
    for (const plane of this.planes) {
      this.scene.remove(plane);
      plane.geometry.dispose();
      plane.material.map.dispose();
      plane.material.dispose();
    }
    this.groups = [];
    this.planes = [];
  }

  // Planes that several worlds share are drawn once.
  addPlanes() {
    const {geoms, shapeNames} = this.replay;
    const side = 2 * Math.ceil(Math.max(60, 8 * this.box.getSize(new THREE.Vector3()).length()));
    const seen = new Set();
    for (let g = 0; g < geoms.kind.length; ++g) {
      if (shapeNames[geoms.shape[g]] !== 'plane' || !this.offsets.has(geoms.world[g])) continue;
      const pose = geoms.local.subarray(7 * g, 7 * g + 7);
      if (seen.has(pose.join())) continue;
      seen.add(pose.join());
      const plane = pb.checkerPlane(side);
      plane.receiveShadow = true;
      plane.applyMatrix(pb.poseMatrix(pose, 0));
      // Under the middle of the action, in whole squares so that the pattern keeps its place.
      const centre = this.box.getCenter(new THREE.Vector3());
      plane.translateX(2 * Math.round(centre.x / 2));
      plane.translateY(2 * Math.round(centre.y / 2));
      this.planes.push(plane);
      this.scene.add(plane);
    }
    this.scene.background = new THREE.Color(pb.themeColour('sky'));
    this.scene.fog = new THREE.Fog(pb.themeColour('sky'), 0.12 * side, 0.48 * side);
  }

  // A sample of the places where bodies of the shown worlds are, over all frames.
  actionPoints() {
    const {numFrames, numBodies, position, bodyWorld} = this.replay;
    const every = Math.max(1, Math.floor(numFrames * numBodies / 20000));
    const points = [];
    for (let i = 0; i < numFrames * numBodies; i += every) {
      const offset = this.offsets.get(bodyWorld[i % numBodies]);
      const [x, y, z] = position.subarray(3 * i, 3 * i + 3);
      if (offset && isFinite(x + y + z)) points.push(new THREE.Vector3(x + offset[0], y + offset[1], z));
    }
    return points;
  }

  // Where things happen: the box round the points, without those that fly far out: a quarter of the middle 98 %'s
  // width beyond these, and the width of where all begins (at least 3 m) beyond that.
  actionBox() {
    const box = new THREE.Box3(new THREE.Vector3(), new THREE.Vector3());
    const start = this.startBox();
    for (const axis of ['x', 'y', 'z']) {
      const values = this.points.map((point) => point[axis]).sort((a, b) => a - b);
      if (values.length === 0) continue;
      const low = values[Math.floor(0.01 * values.length)];
      const high = values[Math.ceil(0.99 * values.length) - 1];
      const reach = Math.max(3, start.max[axis] - start.min[axis]);
      box.min[axis] = Math.max(values[0], low - 0.25 * (high - low), start.min[axis] - reach);
      box.max[axis] = Math.min(values[values.length - 1], high + 0.25 * (high - low), start.max[axis] + reach);
    }
    return box.expandByScalar(0.5);
  }

  // From where one looks: from ahead and the right of where bodies go on the whole, so that they come towards the
  // viewer; from the front left where nothing goes anywhere.
  viewDirection() {
    const {numFrames, numBodies, position, bodyWorld} = this.replay;
    const way = new THREE.Vector2();
    let shown = 0;
    for (let body = 0; body < numBodies; ++body) {
      const first = 3 * body, last = 3 * (numBodies * (numFrames - 1) + body);
      const dx = position[last] - position[first], dy = position[last + 1] - position[first + 1];
      if (!this.offsets.has(bodyWorld[body]) || !isFinite(dx + dy)) continue;
      way.add(new THREE.Vector2(dx, dy));
      ++shown;
    }
    this.driftM = way.length() / Math.max(1, shown);
    // Less than 5 cm a body on the mean is no direction.
    const heading = this.driftM > 0.05 ? way.angle() : Math.PI + 0.3;
    const azimuth = heading - 0.95;
    return new THREE.Vector3(Math.cos(azimuth), Math.sin(azimuth), 0.46).normalize();
  }

  // Lights this box and casts the shadows in it.
  placeSun(box) {
    const centre = box.getCenter(new THREE.Vector3());
    const radius = Math.max(4, 0.62 * box.getSize(new THREE.Vector3()).length());
    const camera = this.sun.shadow.camera;
    // Over the viewer's left shoulder, high.
    const from = new THREE.Vector3(this.away.x, this.away.y, 0).normalize().applyAxisAngle(this.camera.up, -0.6);
    this.sun.position.copy(centre).addScaledVector(from.multiplyScalar(0.8).setZ(1.2), 1.6 * radius);
    this.sun.target.position.copy(centre);
    Object.assign(camera, {left: -radius, right: radius, top: radius, bottom: -radius, near: 0.1, far: 5 * radius});
    camera.updateProjectionMatrix();
    const pixels = radius > 30 ? 4096 : 2048;
    if (this.sun.shadow.map) this.sun.shadow.map.dispose();
    this.sun.shadow.map = null;
    this.sun.shadow.mapSize.set(pixels, pixels);
    this.sun.shadow.bias = -0.0004;
  }

  // Three-quarter view that the action fills; or, with poses, what the bodies fill now. Perspective moves the middle of what is seen away from the middle of
  // the box, so that place and distance are found together, in a few rounds.
  resetCamera(poses) {
    const points = poses ? this.pointsOf(poses) : this.points.filter((point) => this.box.containsPoint(point));
    const box = poses ? new THREE.Box3().setFromPoints(points).expandByScalar(1) : this.box;
    this.placeSun(box);
    const target = box.getCenter(new THREE.Vector3());
    const away = this.away;
    const right = new THREE.Vector3().crossVectors(this.camera.up, away).normalize();
    const up = new THREE.Vector3().crossVectors(away, right);
    const tangent = Math.tan(this.camera.fov * Math.PI / 360);
    // So much of the picture is filled: points are the middles of bodies, and some come near.
    const filled = poses ? 0.62 : this.offsets.size > 1 ? 0.92 : 0.82;
    let distance = 2 * box.getSize(new THREE.Vector3()).length();
    for (let round = 0; round < 12; ++round) {
      this.setCamera(target.clone().addScaledVector(away, distance).toArray(), target.toArray());
      const {low, high} = this.projectedBounds(points);
      target.addScaledVector(right, (low.x + high.x) / 2 * distance * tangent * this.camera.aspect);
      target.addScaledVector(up, (low.y + high.y) / 2 * distance * tangent);
      distance = Math.max(2.5, distance * Math.max(high.x - low.x, high.y - low.y) / 2 / filled);
    }
    this.setCamera(target.clone().addScaledVector(away, distance).toArray(), target.toArray());
  }

  // Bounds of these points in the picture, whose edges are at -1 and 1.
  projectedBounds(points) {
    this.camera.updateMatrixWorld();
    const low = new THREE.Vector2(Infinity, Infinity), high = new THREE.Vector2(-Infinity, -Infinity);
    for (const point of points.length > 0 ? points : [this.box.min, this.box.max]) {
      const seen = point.clone().project(this.camera);
      low.min(seen);
      high.max(seen);
    }
    return {low, high};
  }

  setCamera(position, target) {
    this.camera.position.set(...position);
    this.controls.target.set(...target);
    this.controls.update();
  }

  // Do the bodies on the whole go farther than they stand apart at the start?
  drifts() {
    return this.driftM > this.startBox().getSize(new THREE.Vector3()).length();
  }

  startBox() {
    const {numBodies, position, orientation} = this.replay;
    const start = {position: position.subarray(0, 3 * numBodies), orientation: orientation.subarray(0, 4 * numBodies)};
    return new THREE.Box3().setFromPoints(this.pointsOf(start));
  }

  moveCamera(by) {
    this.sun.position.add(by);
    this.sun.target.position.add(by);
    this.camera.position.add(by);
    this.controls.target.add(by);
    this.controls.update();
  }

  // Where the shown bodies are now.
  pointsOf(poses) {
    const points = [];
    for (let body = 0; body < this.replay.numBodies; ++body) {
      const offset = this.offsets.get(this.replay.bodyWorld[body]);
      const [x, y, z] = poses.position.subarray(3 * body, 3 * body + 3);
      if (offset && isFinite(x + y + z)) points.push(new THREE.Vector3(x + offset[0], y + offset[1], z));
    }
    return points;
  }

  middle(poses) {
    const points = this.pointsOf(poses);
    return points.reduce((sum, point) => sum.add(point), new THREE.Vector3()).divideScalar(Math.max(1, points.length));
  }

  setPoses(poses) {
    const matrix = new THREE.Matrix4(), product = new THREE.Matrix4(), place = new THREE.Vector3(), turn = new THREE.Quaternion();
    const one = new THREE.Vector3(1, 1, 1);
    let body = -2, world = -1;
    for (const {mesh, members} of this.groups) {
      members.forEach((member, index) => {
        if (member.body !== body || member.world !== world) {
          body = member.body;
          world = member.world;
          const offset = this.offsets.get(world);
          if (body < 0) {
            place.set(0, 0, 0);
            turn.set(0, 0, 0, 1);
          } else {
            place.fromArray(poses.position, 3 * body);
            turn.set(poses.orientation[4 * body + 1], poses.orientation[4 * body + 2],
                     poses.orientation[4 * body + 3], poses.orientation[4 * body]);
          }
          place.x += offset[0];
          place.y += offset[1];
          matrix.compose(place, turn, one);
        }
        mesh.setMatrixAt(index, product.multiplyMatrices(matrix, member.local));
      });
      mesh.instanceMatrix.needsUpdate = true;
    }
  }

  resize() {
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
  }

  render() {
    this.renderer.render(this.scene, this.camera);
  }
};
