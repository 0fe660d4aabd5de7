/// The data of a run's file that are known before its first frame.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/hdf5/parameter.h"
#include "stepping/frame.h"

namespace pbmpi::io {

/// Groups that a file has only if the run measures what they hold.
struct OptionalColumns {
  bool profile = false;    ///< every frame has step profiles: /timings/island and /timings/space
  bool estimate = false;   ///< every frame has an EstimateRecord: /estimate
  bool residuals = false;  ///< every frame has Observables::residuals: /observables/residual
  bool contacts = false;   ///< every frame has StepContacts: /contacts and forces in /observables/joint
  bool breaks = false;     ///< joints can break in any world: /observables/joint/broken_in
  bool interest = false;   ///< every frame has Observables::bodies_inside: /observables/interest
};

/// Numbers of rows and items of a run's file.
struct RunShape {
  std::int64_t num_bodies = 0;
  int num_worlds = 0;
  int num_ranks = 1;
  std::int64_t num_frames = 0;
  int record_every = 1;
  OptionalColumns optional;
  std::int64_t first_frame = 0;  ///< number of the file's first frame
  std::int64_t num_geoms = 0, num_joints = 0;
  double substep_s = 0;  ///< length of the substep in which the forces of contacts act

  std::int64_t num_recorded() const { return num_frames / record_every; }
};

/// A parameter in which worlds differ from the scene: a column of /world_parameters. Either `numbers` or
/// `texts` is [num_worlds].
struct WorldParameter {
  std::string key;
  std::vector<double> numbers;  ///< NaN: as in the scene
  std::vector<std::string>
      texts;  ///< as TOML, if the value is not a number in every world; empty: as in the scene
};

/// Everything that is known before the first frame. Equal on every rank, except `worlds`.
struct RunSetup {
  std::string path;  ///< final name of the file
  std::vector<Parameter>
      attributes;  ///< of the root: pbmpi_version, git_revision, seed, scene, command_line ...
  std::vector<Parameter> parameters;  ///< of /parameters
  std::vector<WorldParameter> world_parameters;
  stepping::WorldTable table;
  std::vector<stepping::LocalWorld> worlds;  ///< this rank's worlds at the start, by ascending id
  std::int64_t first_world = 0;              ///< number in the ensemble of the run's first world
  std::vector<std::string> hosts;            ///< [num_ranks]
  std::int64_t first_frame = 0;              ///< frames done before, for a resumed run
  std::int64_t num_frames = 0;               ///< of this file, warm-up included
  int record_every = 1;  ///< the bodies of every record_every-th frame of this file are stored
  double flush_interval_s = 1;
  double substep_s = 0;  ///< dt over the substeps: forces of contacts times it are impulses
  OptionalColumns optional;
};

}  // namespace pbmpi::io
