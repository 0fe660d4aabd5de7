"""pbreport join: a run and its continuations from checkpoints as one file."""
