/// MuJoCo's model and data of one world, and MuJoCo's messages.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include <mujoco/mujoco.h>

#include "core/error.h"

namespace pbmpi::mujoco {

/// MuJoCo called mju_error(), which would end the process.
class EngineError : public core::RunError {
 public:
  using core::RunError::RunError;
};

/// A world needs more than MuJoCo can address.
class TooLarge : public core::InputError {
 public:
  using core::InputError::InputError;
};

/// Does the message say that MuJoCo's stack was too small?
bool is_stack_overflow(const std::exception& error);

/// While it lives, MuJoCo's errors are thrown as EngineError, and its warnings, which otherwise go to a file
/// in the working directory, are dropped: mjData counts them. The previous handlers are restored. Handlers
/// are variables of the whole process, so two threads must not step at the same time.
///
/// The exception passes through MuJoCo's C functions, which hold nothing that has to be freed; the ABIs of
/// x86-64 and AArch64 give them unwind tables. The mjData in use must not be stepped again.
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

/// A model with data of a given size. Call its functions in a MessageScope.
class Engine {
 public:
  /// Compiles a model from MJCF. `text` returns the MJCF for a stack of so many numbers; it is called with
  /// `stack`, or with more where MuJoCo finds that too small. The text has no room and no constraints, which
  /// would slow down the trial step that MuJoCo makes with each model. Throws TooLarge, or core::InputError
  /// with MuJoCo's message.
  Engine(const std::function<std::string(int stack)>& text, int stack);

  mjModel& model() { return *model_; }
  const mjModel& model() const { return *model_; }
  mjData& data() { return *data_; }
  const mjData& data() const { return *data_; }

  /// Makes room for so many contacts and constraint rows, if there is less. The data are then new, except
  /// qpos and qvel. Throws TooLarge before it allocates memory. The amount of room changes no bit of a step.
  void make_room(int contacts, int rows);
  /// Would make_room() succeed?
  bool fits(int contacts, int rows) const;
  /// Doubles MuJoCo's stack, whose required size is known only once it is too small. Throws TooLarge.
  void make_stack();

 private:
  void make_data();

  std::unique_ptr<mjModel, void (*)(mjModel*)> model_;
  std::unique_ptr<mjData, void (*)(mjData*)> data_;
};

/// Stack size in numbers with which MuJoCo should be able to compile a model and make its trial step. Throws
/// TooLarge.
int stack_to_compile(int bodies, int degrees_of_freedom);

/// Bytes of the buffer of mjData.
std::size_t data_bytes(const mjModel& sizes, int contacts, int rows);

}  // namespace pbmpi::mujoco
