#include "mujoco/engine.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string_view>
#include <vector>

#include <fmt/core.h>
#include <mujoco/mjxmacro.h>

namespace pbmpi::mujoco {
namespace {

/// MuJoCo 2.2 stores the size of mjData's buffer in bytes, and that of its stack in numbers, as an int.
constexpr std::size_t most_of_int = std::numeric_limits<int>::max();

constexpr const char* remedy = "step it with sor or quick, or make the world smaller";

[[noreturn]] void on_error(const char* message) { throw EngineError(std::string("mujoco: ") + message); }

void on_warning(const char*) {}

std::unique_ptr<mjModel, void (*)(mjModel*)> load(const std::string& mjcf) {
  constexpr const char* name = "world.xml";
  const auto files = std::make_unique<mjVFS>();  // too large for the stack
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), name, static_cast<int>(mjcf.size()));
  std::memcpy(files->filedata[mj_findFileVFS(files.get(), name)], mjcf.data(), mjcf.size());
  std::array<char, 1000> message{};
  std::unique_ptr<mjModel, void (*)(mjModel*)> model(
      mj_loadXML(name, files.get(), message.data(), static_cast<int>(message.size())), mj_deleteModel);
  mj_deleteVFS(files.get());
  mj_freeLastXML();
  core::require_input(model != nullptr, std::string("mujoco: it refuses this world: ") + message.data());
  return model;
}

std::string gigabytes(std::size_t bytes) {
  return fmt::format("{:.1f} GB", 1e-9 * static_cast<double>(bytes));
}

/// Refuses a world whose solver asks for `stack` numbers if that is too many.
void require_stack(int bodies, int degrees_of_freedom, std::size_t stack) {
  if (stack <= most_of_int) return;
  throw TooLarge("mujoco: a world of " + std::to_string(bodies) + " bodies with " +
                 std::to_string(degrees_of_freedom) + " degrees of freedom takes " + gigabytes(8 * stack) +
                 " for the solver's matrices, and MuJoCo " + mj_versionString() + " addresses no more than " +
                 gigabytes(8 * most_of_int) + " of them; " + remedy);
}

/// Refuses mjData with room for so many rows if that is too large.
void require_buffer(const mjModel& model, int rows, std::size_t bytes) {
  if (bytes <= most_of_int) return;
  throw TooLarge("mujoco: a world of " + std::to_string(model.nbody - 1) + " bodies with " +
                 std::to_string(model.nv) + " degrees of freedom and room for " + std::to_string(rows) +
                 " constraint rows takes " + gigabytes(bytes) + ", and MuJoCo " + mj_versionString() +
                 " addresses no more than " + gigabytes(most_of_int) + "; " + remedy);
}

/// Newton's solver was seen to take ten matrices of all degrees of freedom, and the broad phase lists pairs
/// of bodies. Memory that is not used is not touched.
std::size_t stack_for(std::size_t bodies, std::size_t degrees_of_freedom, std::size_t rows) {
  return 12 * degrees_of_freedom * degrees_of_freedom + bodies * bodies +
         rows * (2 * degrees_of_freedom + 50) + 100 * degrees_of_freedom + 10000;
}

std::size_t stack_for(const mjModel& model, int rows) {
  return stack_for(static_cast<std::size_t>(model.nbody), static_cast<std::size_t>(model.nv),
                   static_cast<std::size_t>(rows));
}

}  // namespace

bool is_stack_overflow(const std::exception& error) {
  return std::string_view(error.what()).find("tack overflow") != std::string_view::npos;
}

MessageScope::MessageScope() : error_(mju_user_error), warning_(mju_user_warning) {
  mju_user_error = on_error;
  mju_user_warning = on_warning;
}

MessageScope::~MessageScope() {
  mju_user_error = error_;
  mju_user_warning = warning_;
}

Engine::Engine(const std::function<std::string(int)>& text, int stack)
    : model_(nullptr, mj_deleteModel), data_(nullptr, mj_deleteData) {
  while (!model_) {
    try {
      model_ = load(text(stack));
    } catch (const core::InputError& error) {
      constexpr int most_to_double = static_cast<int>(most_of_int / 2);
      if (!is_stack_overflow(error) || stack > most_to_double) throw;
      stack *= 2;
    }
  }
  model_->njmax = model_->nconmax = 0;
  model_->opt.disableflags &= ~mjDSBL_CONSTRAINT;
}

bool Engine::fits(int contacts, int rows) const {
  return data_bytes(*model_, contacts, rows) <= most_of_int && stack_for(*model_, rows) <= most_of_int;
}

void Engine::make_room(int contacts, int rows) {
  if (data_ && contacts <= model_->nconmax && rows <= model_->njmax) return;
  contacts = std::max(contacts, model_->nconmax);
  rows = std::max(rows, model_->njmax);
  const std::size_t stack = std::max(stack_for(*model_, rows), static_cast<std::size_t>(model_->nstack));
  require_buffer(*model_, rows, data_bytes(*model_, contacts, rows));
  require_stack(model_->nbody - 1, model_->nv, stack);
  model_->nconmax = contacts;
  model_->njmax = rows;
  model_->nstack = static_cast<int>(stack);
  make_data();
}

void Engine::make_stack() {
  const std::size_t stack = 2 * static_cast<std::size_t>(model_->nstack);
  require_stack(model_->nbody - 1, model_->nv, stack);
  model_->nstack = static_cast<int>(stack);
  make_data();
}

void Engine::make_data() {
  std::vector<mjtNum> qvel;
  if (data_) qvel.assign(data_->qvel, data_->qvel + model_->nv);
  data_.reset();  // first, so that memory never has to hold both
  data_.reset(mj_makeData(model_.get()));
  if (!data_) throw EngineError("mujoco: no memory for mjData");
  std::ranges::copy(qvel, data_->qvel);
}

int stack_to_compile(int bodies, int degrees_of_freedom) {
  constexpr std::size_t rows_of_a_try = 100, spare = 100000;
  const std::size_t stack = spare + stack_for(static_cast<std::size_t>(bodies) + 1,
                                              static_cast<std::size_t>(degrees_of_freedom), rows_of_a_try);
  require_stack(bodies, degrees_of_freedom, stack);
  return static_cast<int>(stack);
}

std::size_t data_bytes(const mjModel& sizes, int contacts, int rows) {
  const auto nv = static_cast<std::size_t>(sizes.nv), njmax = static_cast<std::size_t>(rows);
  mjModel asked = sizes;
  asked.nconmax = contacts;
  asked.njmax = rows;
  std::size_t bytes = 0;
  constexpr std::size_t alignment = 64;
#define X(type, name, nr, nc) bytes += sizeof(type) * static_cast<std::size_t>(asked.nr) * (nc) + alignment;
  MJDATA_POINTERS
#undef X
  return bytes;
}

}  // namespace pbmpi::mujoco
