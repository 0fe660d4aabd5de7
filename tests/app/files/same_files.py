"""What a run's file holds beside clocks, as bytes: equal for any number of ranks (io/SCHEMA.md)."""
import h5py
import numpy

# What the clock says, and what says how the work was dealt out.
OF_THE_CLOCK = {
    "/timings/frame/wall", "/timings/frame/deadline_met", "/timings/island/solve", "/timings/space/collide",
    "/timings/space/collide_spaces", "/world_results/cost", "/world_results/moves", "/estimate/delivered", "/estimate/precise"}
OF_THE_RANKS = ("/ranks/", "/timings/rank/", "/parameters/", "/checksums/timings.", "/checksums/estimate.delivered",
                "/estimate/compute", "/checksums/estimate.compute",
                "/checksums/events.")
# A rebalance follows measured times.
EVENTS_OF_THE_CLOCK = {b"rebalance"}


def events(group):
    """Rows of /events, those left out that follow a clock."""
    kept = [kind not in EVENTS_OF_THE_CLOCK for kind in group["kind"][:]]
    return {f"/events/{name}": group[name][:][kept].tobytes() for name in group}


def content(path):
    """Bytes, type and shape of every dataset of the file that neither clock nor ranks decide, by its name."""
    found = {}

    def visit(name, thing):
        name = "/" + name
        if not isinstance(thing, h5py.Dataset) or name in OF_THE_CLOCK:
            return
        if name.startswith(OF_THE_RANKS) or name.startswith("/events/"):
            return
        found[name] = (thing.dtype.str, thing.shape, numpy.asarray(thing[()]).tobytes())

    with h5py.File(path) as file:
        file.visititems(visit)
        found.update(events(file["events"]))
        found["state_hash"] = file.attrs["state_hash"]
        for name in ("frames_committed", "complete", "record_every", "first_frame"):
            found[name] = file.attrs[name]
        for name, value in file["events"].attrs.items():
            if name not in ("num_events", "num_rebalance", "num_dropped", "worlds_moved"):
                found[f"/events@{name}"] = value
        # Of rebalances the first 64 have a row.
        rebalances = file["events"].attrs["num_rebalance"]
        found["/events@num_dropped"] = file["events"].attrs["num_dropped"] - max(0, rebalances - 64)
    return found


def differences(one, other):
    """Names of what is not the same in both, in alphabetical order."""
    return sorted(name for name in one.keys() | other.keys() if one.get(name) != other.get(name))
