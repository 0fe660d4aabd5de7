"""What the files of run_writer must hold: the numbers of sample_run.cpp, worked out anew."""
import os
import subprocess

import h5py
import numpy as np

NUM_WORLDS = 20
# Once a rank has failed mpirun gives the others a second to end by themselves. What ends in good order does not need it.
AT_ONCE = {"OMPI_MCA_odls_base_sigkill_timeout": "0"}


def writer_command(mpiexec, ranks, writer, path, planned, frames, record_every=1, flush_s=0.0, move=0, pause_us=0,
                   limit_bytes=0):
    arguments = [planned, frames, record_every, flush_s, move, pause_us, limit_bytes]
    return [mpiexec, "-n", str(ranks), writer, path] + [str(a) for a in arguments]


def run_writer(*args, **kwargs):
    return subprocess.run(writer_command(*args, **kwargs), capture_output=True, text=True, timeout=40,
                          env={**os.environ, **AT_ONCE})


def world_and_body():
    world = np.concatenate([np.full(8 + w % 2, w) for w in range(NUM_WORLDS)])
    body = np.concatenate([np.arange(8 + w % 2) for w in range(NUM_WORLDS)])
    return world, body


def positions(frames):
    """[len(frames)][N][3]; every term is a multiple of 1/16, so the sums are exact."""
    world, body = world_and_body()
    in_frame = 1000.0 * world[:, None] + 10.0 * body[:, None] + 0.0625 * np.arange(3) + 1.0
    return in_frame[None] + 0.25 * np.asarray(frames, dtype=float)[:, None, None]


def check_models(f, world, body):
    """What is written once of bodies, joints, materials and worlds."""
    bodies, joints = f["particles/bodies"], f["joints"]
    inertia = np.array([[[4 + b, 0.5, 0.25], [0.5, 5, 0.125], [0.25, 0.125, 6 + w]] for w, b in zip(world, body)])
    assert np.array_equal(bodies["inertia"][:], inertia)
    assert np.array_equal(bodies["initial_velocity"][:], np.stack([body, 0 * body, world], axis=1))
    first = np.searchsorted(world, np.arange(NUM_WORLDS))
    of_world = [2 - w % 2 for w in range(NUM_WORLDS)]
    assert np.array_equal(joints["world"][:], np.repeat(np.arange(NUM_WORLDS), of_world))
    necks = joints["local_joint"][:] == 0
    assert list(joints["name"].asstr()[:2]) == ["human1.neck", "human1.rope"]
    assert set(joints["kind"].asstr()[:][necks]) == {"universal"} and set(joints["kind"].asstr()[:][~necks]) == {"ball"}
    assert np.array_equal(joints["body_a"][:][necks], first + 1) and np.array_equal(joints["body_b"][:][necks], first)
    assert np.array_equal(joints["body_a"][:][~necks], first[::2] + 2) and set(joints["body_b"][:][~necks]) == {-1}
    assert np.array_equal(joints["anchor_a"][:][necks], [[0.5 * w, 0.25, 0] for w in range(NUM_WORLDS)])
    assert np.array_equal(joints["limit_low"][0], [-1, -np.inf]) and np.array_equal(joints["limit_high"][0], [2, np.inf])
    assert list(joints["motor_max_force"][0]) == [8, 0] and joints["motor_hold_rate"][0, 0] == 0.25
    assert np.array_equal(f["pair_materials/mu"][:], 0.25 * np.arange(NUM_WORLDS))
    assert set(f["pair_materials/actor_b"].asstr()[:]) == {"human1"} and set(f["geoms/actor"].asstr()[:]) == {"floor", "human1"}
    assert np.array_equal(f["worlds/gravity"][:], [[0, 0, -9.81]] * NUM_WORLDS)


def check_contacts(f, committed):
    """The contacts of each frame, and what joints hold with."""
    assert all(d == 0 for d in f["contacts/frame/dropped"][:committed])
    names = f["contacts/point"].attrs["columns"].decode().split()
    first_body = np.searchsorted(f["particles/bodies/world"][:], np.arange(NUM_WORLDS))
    first_geom = np.searchsorted(f["geoms/world"][:], np.arange(NUM_WORLDS))
    next_row = 0
    for k in range(committed):
        first, count = int(f["contacts/frame/first"][k]), int(f["contacts/frame/count"][k])
        assert first == next_row, (k, first, next_row)
        next_row += count
        rows = [(w, i) for w in range(NUM_WORLDS) for i in range((w + k) % 4)]
        assert count == len(rows)
        point = dict(zip(names, f["contacts/point"][first:first + count].T))
        w, i = np.array(rows, dtype=float).reshape(-1, 2).T
        world, geom = w.astype(int), first_geom[w.astype(int)]
        expected = {"world": w, "geom_a": geom, "geom_b": geom + 1 + i, "body_a": first_body[world] + i % 2, "body_b": -1 + 0 * w,
                    "awake": 1 + 0 * w, "position_x": w, "position_y": k + 0 * w, "position_z": i, "normal_x": 0 * w,
                    "normal_z": 1 + 0 * w, "depth": 0.25 * i, "mu": 0.5 + 0 * w, "arm_x": 0.5 + 0 * w, "arm_z": k + 0 * w,
                    "normal_force": 8 * (i + 1), "friction_x": w, "friction_y": -k + 0 * w, "impulse_x": 0.5 * w,
                    "impulse_y": -0.5 * k + 0 * w, "impulse_z": 4 * (i + 1)}
        for name, values in expected.items():
            assert np.array_equal(point[name], values), (k, name)
    joint, frames = f["observables/joint"], np.arange(committed)
    world, first = f["joints/world"][:], f["joints/local_joint"][:] == 0
    broken = first[None] & (frames >= 3)[:, None]
    assert np.array_equal(joint["broken_in"][:committed], np.where(broken, 7, -1))
    force = np.stack([world + 0 * frames[:, None], frames[:, None] + 0 * world, 1 + 0 * world + 0 * frames[:, None]], axis=2)
    assert np.array_equal(joint["force"][:committed], np.where(broken[:, :, None], 0, force))
    assert np.array_equal(joint["control"][:committed, :, 1], np.where(broken, 0, -frames[:, None]))


def check(path):
    """Asserts that all committed rows are finite and right, and returns how many frames are committed."""
    with h5py.File(path, "r") as f:
        committed = int(f.attrs["frames_committed"])
        every = int(f.attrs["record_every"])
        bodies = f["particles/bodies"]
        world, body = world_and_body()
        assert np.array_equal(bodies["world"][:], world) and np.array_equal(bodies["local_body"][:], body)
        check_models(f, world, body)
        check_contacts(f, committed)
        recorded = np.arange(committed // every) * every + every - 1
        expected = positions(recorded)
        rows = slice(0, len(recorded))
        for name, factor in (("position", 1), ("velocity", -1), ("angular_velocity", 2)):
            found = bodies[name]["value"][rows]
            assert np.all(np.isfinite(found)), f"{path}: {name} is not finite"
            assert np.array_equal(found, factor * expected), f"{path}: {name} is wrong"
        assert np.array_equal(bodies["orientation/value"][rows][:, :, 3], 0.5 * np.repeat(recorded, len(world))
                              .reshape(len(recorded), len(world)))
        ahead = f["estimate/position/value"][rows] - expected
        assert np.array_equal(ahead, np.broadcast_to([0.5, 0, 0], ahead.shape)), f"{path}: an estimate is wrong"
        assert np.array_equal(f["estimate/orientation/value"][rows], bodies["orientation/value"][rows])
        assert np.array_equal(bodies["position/step"][rows], 3 * (recorded + 1))
        frames = np.arange(committed)
        contacts = f["observables/world/contacts"][:committed]
        assert np.array_equal(contacts, 100 * np.arange(NUM_WORLDS)[None] + frames[:, None])
        inside = f["observables/interest/bodies_inside"][:committed]
        assert np.array_equal(inside, 10 * np.arange(NUM_WORLDS)[None] + frames[:, None])
        residual = f["observables/residual"]
        assert np.array_equal(residual["joint_speed"][:committed, 0], 1e-3 * (frames + 1))
        assert np.array_equal(residual["joint_turn"][:committed, 0], 2e-3 * frames)
        excess = residual["complementarity"][:committed]
        assert np.array_equal(excess, np.broadcast_to(1e-4 * np.arange(NUM_WORLDS), excess.shape))
        assert np.array_equal(residual["natural_speed"][:committed, 0], 3e-3 * (frames + 1))
        assert np.array_equal(residual["natural_turn"][:committed, 0], 4e-3 * frames)
        assert np.array_equal(f["timings/frame/wall"][:committed], 1e-3 * (frames + 1))
        ranks = np.arange(f["timings/rank/useful"].shape[1])
        collide = 1e-4 * (ranks[None] + 1) + 1e-5 * 1 + 1e-6 * frames[:, None]
        assert np.array_equal(f["timings/rank/collide"][:committed], collide)
        assert np.array_equal(f["estimate/delivered"][:committed], 0.25 * f["timings/frame/wall"][:committed])
        assert np.array_equal(f["estimate/precise"][:committed], f["timings/frame/wall"][:committed])
        assert np.array_equal(f["estimate/compute"][:committed], 1e-4 * (ranks + 1) * np.ones((committed, 1)))
        for name, column in f["events"].items():
            assert len(column) >= f["events"].attrs["num_events"], name
        assert np.array_equal(f["events/frame"][:f["events"].attrs["num_events"]] % 4, np.ones(
            f["events"].attrs["num_events"]))
        return committed


def only_file_in(folder, names):
    assert sorted(os.listdir(folder)) == sorted(names), sorted(os.listdir(folder))
