/// MuJoCo's model and data of one world, and what MuJoCo says of them.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include <mujoco/mujoco.h>

#include "core/error.h"

namespace pbmpi::mujoco {

/// MuJoCo would end the process: mju_error() was called.
class EngineError : public core::RunError {
 public:
  using core::RunError::RunError;
};

/// What a world asks for is more than MuJoCo can address.
class TooLarge : public core::InputError {
 public:
  using core::InputError::InputError;
};

/// Does the message say that MuJoCo's stack was too small?
bool is_stack_overflow(const std::exception& error);

/// While it lives, MuJoCo's errors are thrown as EngineError, and its warnings, which otherwise go to a file
/// in the working directory, are dropped: mjData counts them. The handlers found are put back. They are
/// variables of the whole process, so that two threads must not step at the same time.
///
/// The exception passes through MuJoCo's C functions, which hold nothing that wants to be freed; the ABIs of
/// x86-64 and AArch64 give them the tables for it. The mjData in use must not be stepped again.
class MessageScope {
 public:
  MessageScope();
  ~MessageScope();
  MessageScope(const MessageScope&) = delete;
  MessageScope& operator=(const MessageScope&) = delete;

 private:
  void (*error_)(const char*);
  void (*warning_)(const char*);
};

/// A model with data of such a size. Call its functions in a MessageScope.
class Engine {
 public:
  /// Compiles a model from MJCF, which `text` gives for a stack of so many numbers: of `stack`, or of more
  /// where MuJoCo finds that too small. The text has no room and no constraints, which would cost a step for
  /// the trial that MuJoCo makes of each model. Throws TooLarge, or core::InputError with MuJoCo's message.
  Engine(const std::function<std::string(int stack)>& text, int stack);

  mjModel& model() { return *model_; }
  const mjModel& model() const { return *model_; }
  mjData& data() { return *data_; }
  const mjData& data() const { return *data_; }

  /// Makes room for so many contacts and constraint rows, if there is less. The data then is new, but for
  /// qpos and qvel. Throws TooLarge before it asks for memory. Room moves no bit of a step.
  void make_room(int contacts, int rows);
  /// Would make_room() not throw?
  bool fits(int contacts, int rows) const;
  /// Doubles MuJoCo's stack, whose need is known only once it is too small. Throws TooLarge.
  void make_stack();

 private:
  void make_data();

  std::unique_ptr<mjModel, void (*)(mjModel*)> model_;
  std::unique_ptr<mjData, void (*)(mjData*)> data_;
};

/// Numbers on the stack with which MuJoCo should be able to compile a model, and to try a step of it. Throws
/// TooLarge.
int stack_to_compile(int bodies, int degrees_of_freedom);

/// Bytes of the buffer of mjData.
std::size_t data_bytes(const mjModel& sizes, int contacts, int rows);

}  // namespace pbmpi::mujoco
