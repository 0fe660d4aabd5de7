'use strict';
// Geoms as unit solids: every geom is one or three instances (a capsule: tube and two caps) of a solid of unit
// size, scaled and placed by one matrix in its body's frame. All instances of one solid and one colour are drawn
// at once.

// Finer solids for few instances. All have their axis along z, as the geoms do.
pb.unitSolids = (numInstances) => {
  const around = numInstances > 8000 ? 10 : numInstances > 1500 ? 16 : 28;
  const upright = (geometry) => geometry.rotateX(Math.PI / 2);
  return {
    box: new THREE.BoxBufferGeometry(1, 1, 1),
    ball: new THREE.SphereBufferGeometry(1, around, around / 2),
    drum: upright(new THREE.CylinderBufferGeometry(1, 1, 1, around)),
    tube: upright(new THREE.CylinderBufferGeometry(1, 1, 1, around, 1, true)),
    cap: upright(new THREE.SphereBufferGeometry(1, around, Math.ceil(around / 4), 0, 2 * Math.PI, 0, Math.PI / 2)),
  };
};

// A hull, or a mesh, as a solid in its own size.
pb.hullSolid = (corners) => {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(corners, 3));
  geometry.computeVertexNormals();
  return geometry;
};

// The solids of a geom: name, place along the local z axis [m], scale, whether upside down.
pb.solidsOf = (shape, [a, b, c], hull) => {
  switch (shape) {
    case 'hull':
    case 'mesh': return hull < 0 ? [] : [{solid: `hull${hull}`, z: 0, scale: [1, 1, 1]}];
    case 'sphere': return [{solid: 'ball', z: 0, scale: [a, a, a]}];
    case 'box': return [{solid: 'box', z: 0, scale: [a, b, c]}];
    case 'cylinder': return [{solid: 'drum', z: 0, scale: [a, a, b]}];
    case 'capsule': return [
      {solid: 'tube', z: 0, scale: [a, a, b]},
      {solid: 'cap', z: b / 2, scale: [a, a, a]},
      {solid: 'cap', z: -b / 2, scale: [a, a, a], upsideDown: true},
    ];
    default: return [];  // planes are drawn as ground
  }
};

// Matrix of the pose at `values[at .. at + 6]`: position, orientation (w, x, y, z).
pb.poseMatrix = (values, at) => new THREE.Matrix4().compose(
    new THREE.Vector3(values[at], values[at + 1], values[at + 2]),
    new THREE.Quaternion(values[at + 4], values[at + 5], values[at + 6], values[at + 3]),
    new THREE.Vector3(1, 1, 1));

// All instances of the geoms of some worlds: [{solid, kind, dark, body, world, local: Matrix4, shade}].
pb.instancesOf = (replay, shown) => {
  const {geoms, kindNames, shapeNames} = replay;
  const instances = [];
  for (let g = 0; g < geoms.kind.length; ++g) {
    if (!shown.has(geoms.world[g])) continue;
    const kind = kindNames[geoms.kind[g]];
    const shape = shapeNames[geoms.shape[g]];
    const pose = pb.poseMatrix(geoms.local, 7 * g);
    const vehicle = kind === 'car' || kind === 'tank' || kind === 'centipede';
    for (const part of pb.solidsOf(shape, geoms.size.subarray(3 * g, 3 * g + 3), geoms.hull ? geoms.hull[g] : -1)) {
      const turn = new THREE.Quaternion(part.upsideDown ? 1 : 0, 0, 0, part.upsideDown ? 0 : 1);
      const local = pose.clone().multiply(new THREE.Matrix4().compose(
          new THREE.Vector3(0, 0, part.z), turn, new THREE.Vector3(...part.scale)));
      // Neighbours of one colour differ a little, so that bricks and limbs can be told apart; wheels are dark.
      const shade = vehicle && shape !== 'box' ? 0.42 : 0.86 + 0.14 * ((7 * geoms.body[g] + 10) % 5) / 4;
      instances.push({solid: part.solid, kind, body: geoms.body[g], world: geoms.world[g], local, shade});
    }
  }
  return instances;
};

// A material whose colour is scaled by the instance's `shade` (r111 has no colour per instance).
pb.shadedMaterial = (colour) => {
  const material = new THREE.MeshPhongMaterial({color: colour, shininess: 18, specular: 0x222222});
  material.onBeforeCompile = (shader) => {
    shader.vertexShader = 'attribute float shade;\nvarying float vShade;\n' +
        shader.vertexShader.replace('#include <begin_vertex>', '#include <begin_vertex>\nvShade = shade;');
    shader.fragmentShader = 'varying float vShade;\n' +
        shader.fragmentShader.replace('#include <color_fragment>', 'diffuseColor.rgb *= vShade;');
  };
  return material;
};

// A plane of 1 m squares, for z up in its own frame.
pb.checkerPlane = (side) => {
  const canvas = pb.element('canvas', {width: 256, height: 256});
  const context = canvas.getContext('2d');
  context.fillStyle = pb.themeColour('ground');
  context.fillRect(0, 0, 256, 256);
  context.fillStyle = pb.themeColour('ground-other');
  context.fillRect(0, 0, 128, 128);
  context.fillRect(128, 128, 128, 128);
  context.strokeStyle = pb.themeColour('ground-line');
  context.lineWidth = 2;
  for (const at of [0, 128]) {
    context.strokeRect(at, -8, 128, 272);
    context.strokeRect(-8, at, 272, 128);
  }
  const texture = new THREE.CanvasTexture(canvas);
  texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
  texture.repeat.set(side / 2, side / 2);
  texture.anisotropy = 8;
  return new THREE.Mesh(new THREE.PlaneBufferGeometry(side, side),
                        new THREE.MeshLambertMaterial({map: texture}));
};
