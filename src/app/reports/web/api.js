'use strict';
// Starts the page. pb.replay is its replay; the address tells what it shows:
//   #frame=3        the third recorded frame, 0 = initial pose
//   &world=0|all    what is shown
//   &camera=px,py,pz,tx,ty,tz   position and target [m]
//   &follow=1|0     whether the camera moves with the bodies; default: if they go far
//   &still=1        the picture alone, with legend and time; &bare=1 without these
//   &width=1200&height=675      size of the still in CSS pixels; default: the window
//   &play=1         start playing

pb.readAddress = (replay) => {
  const asked = new URLSearchParams(location.hash.slice(1));
  const view = document.getElementById('view');
  document.body.classList.toggle('still', asked.get('still') === '1');
  document.body.classList.toggle('bare', asked.get('bare') === '1');
  view.style.width = asked.get('width') ? `${Number(asked.get('width'))}px` : '';
  view.style.height = asked.get('height') ? `${Number(asked.get('height'))}px` : '';
  if (asked.get('world')) replay.setWorld(asked.get('world'));
  if (asked.get('frame')) replay.setFrame(asked.get('frame'));
  if (asked.get('follow')) replay.setFollow(asked.get('follow') === '1'); else replay.resetCamera();
  const camera = (asked.get('camera') || '').split(',').map(Number);
  if (camera.length === 6 && camera.every(isFinite)) replay.setCamera(camera.slice(0, 3), camera.slice(3));
  replay.draw();
  if (asked.get('play') === '1') replay.play();
};

pb.start = () => {
  pb.showHeader();
  pb.showPlots();
  pb.showProvenance();
  const data = pb.decodeReplay(pb.json('replay-data'));
  let replay;
  try {
    replay = new pb.Replay(data, new pb.Stage(document.getElementById('canvas'), data));
  } catch (error) {
    const message = document.getElementById('view-error');
    message.textContent = `The 3D replay needs WebGL, which this browser does not offer (${error.message}).`;
    message.hidden = false;
    return;
  }
  replay.onFrame = (frame) => pb.framePlots.setCursor(frame);
  pb.framePlots.onChoose = (frame) => { replay.pause(); replay.setFrame(replay.placeOf(frame)); };
  pb.readAddress(replay);
  window.addEventListener('hashchange', () => pb.readAddress(replay));
  pb.replay = replay;
  const loop = (now) => { replay.tick(now); requestAnimationFrame(loop); };
  requestAnimationFrame(loop);
};

pb.start();
document.body.dataset.ready = 'yes';
