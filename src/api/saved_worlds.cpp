#include "api/saved_worlds.h"

#include <cstring>
#include <string_view>
#include <type_traits>

#include "core/error.h"
#include "core/system/seal.h"
#include "core/text.h"
#include "mpi/frame/whole_state.h"

namespace pbmpi::api {
namespace {

/// The number at the end is raised when the layout changes.
constexpr std::string_view magic = "pbmpi worlds 3\n";

class Writer {
 public:
  explicit Writer(std::vector<std::byte>& to) : to_(&to) {}

  template <class Number>
  requires std::is_arithmetic_v<Number>
  void number(Number value) { bytes(std::as_bytes(std::span(&value, 1))); }
  void text(std::string_view text) {
    number(std::uint64_t{text.size()});
    bytes(std::as_bytes(std::span(text)));
  }
  void numbers(std::span<const double> values) {
    number(std::uint64_t{values.size()});
    bytes(std::as_bytes(values));
  }
  void bytes(std::span<const std::byte> bytes) { to_->insert(to_->end(), bytes.begin(), bytes.end()); }

 private:
  std::vector<std::byte>* to_;
};

/// Checks each length that it reads against the bytes left, so that a wrong one allocates no more than there
/// is.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> from) : left_(from) {}

  template <class Number>
  requires std::is_arithmetic_v<Number> Number number() {
    Number value{};
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  std::string text() {
    const auto bytes = take(number<std::uint64_t>());
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }
  std::vector<double> numbers() {
    const auto count = number<std::uint64_t>();
    core::require_input(count <= left_.size() / sizeof(double), too_short);
    std::vector<double> values(count);
    const auto bytes = take(count * sizeof(double));
    if (count > 0) std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  }
  bool at_end() const { return left_.empty(); }

 private:
  static constexpr const char* too_short = "the saved worlds end too early; they are damaged";

  std::span<const std::byte> take(std::uint64_t count) {
    core::require_input(count <= left_.size(), too_short);
    const auto taken = left_.first(static_cast<std::size_t>(count));
    left_ = left_.subspan(static_cast<std::size_t>(count));
    return taken;
  }

  std::span<const std::byte> left_;
};

void write(const SavedWorld& world, Writer& writer) {
  writer.number(std::int64_t{world.id});
  writer.number(world.step);
  writer.number(world.from.seed);
  writer.number(std::uint64_t{world.from.parameters.size()});
  for (const auto& [key, value] : world.from.parameters) {
    writer.text(key);
    writer.text(value);
  }
  writer.numbers(world.aims);
  writer.numbers(world.loads);
  writer.numbers(world.efforts);
  writer.numbers(mpi::pack(world.state));
}

SavedWorld read_world(Reader& reader) {
  SavedWorld world;
  world.id = static_cast<int>(reader.number<std::int64_t>());
  world.step = reader.number<std::int64_t>();
  world.from.seed = reader.number<std::uint64_t>();
  for (auto left = reader.number<std::uint64_t>(); left > 0; --left) {
    std::string key = reader.text();
    world.from.parameters.emplace(std::move(key), reader.text());
  }
  world.aims = reader.numbers();
  world.loads = reader.numbers();
  world.efforts = reader.numbers();
  world.state = mpi::unpack(reader.numbers());
  return world;
}

void require_expected(const SavedFrom& found, const SavedFrom& expected) {
  const auto require = [](bool same, const std::string& what) { core::require_input(same, what); };
  require(found.version == expected.version, "the worlds were saved by pbmpi " + found.version +
                                                 ", and this is " + expected.version +
                                                 ", which may step to other bits; load them with that one");
  require(found.scene_checksum == expected.scene_checksum,
          "the worlds were saved by a batch of the scene " + core::in_quotes(found.scene) +
              (found.scene == expected.scene ? ", whose text was another"
                                             : ", and this is one of " + core::in_quotes(expected.scene)) +
              "; load them into a batch of that scene");
  require(
      found.settings_checksum == expected.settings_checksum,
      "the worlds were saved by a batch with other settings, and would go on to other bits; make the batch "
      "with the same settings");
}

}  // namespace

std::vector<std::byte> write_worlds(const SavedFrom& from, std::span<const SavedWorld> worlds) {
  std::vector<std::byte> saved;
  Writer writer(saved);
  writer.bytes(std::as_bytes(std::span(magic)));
  writer.text(from.version);
  writer.text(from.scene);
  writer.number(from.scene_checksum);
  writer.number(from.settings_checksum);
  writer.number(std::uint64_t{worlds.size()});
  for (const SavedWorld& world : worlds) write(world, writer);
  core::add_seal(saved);
  return saved;
}

std::vector<SavedWorld> read_worlds(std::span<const std::byte> saved, const SavedFrom& expected) {
  const bool is_ours =
      saved.size() >= magic.size() && std::memcmp(saved.data(), magic.data(), magic.size()) == 0;
  core::require_input(is_ours,
                      "these are no worlds that save() of this pbmpi has written; load what it returned");
  const auto sealed = core::sealed_part(saved);
  core::require_input(sealed && sealed->size() >= magic.size(),
                      "the saved worlds have changed since they were saved; they are damaged");
  Reader reader(sealed->subspan(magic.size()));
  SavedFrom found;
  found.version = reader.text();
  found.scene = reader.text();
  found.scene_checksum = reader.number<std::uint64_t>();
  found.settings_checksum = reader.number<std::uint64_t>();
  require_expected(found, expected);
  std::vector<SavedWorld> worlds;
  for (auto left = reader.number<std::uint64_t>(); left > 0; --left) worlds.push_back(read_world(reader));
  core::require_input(reader.at_end(), "there is more behind the saved worlds; they are damaged");
  return worlds;
}

}  // namespace pbmpi::api
