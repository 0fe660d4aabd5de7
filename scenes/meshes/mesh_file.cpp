#include "scenes/meshes/mesh_file.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <map>
#include <string_view>

#include "core/error.h"
#include "core/text.h"

namespace pbmpi::scenes {
namespace {

bool ends_in(std::string_view path, std::string_view end) {
  if (path.size() < end.size()) return false;
  return std::ranges::equal(path.substr(path.size() - end.size()), end,
                            [](char a, char b) { return (a | 0x20) == (b | 0x20); });
}

/// Gives points with equal coordinates one index.
class PointIndex {
 public:
  explicit PointIndex(Mesh& mesh) : mesh_(mesh) {}

  int of(const core::Vec3& point) {
    const std::array<double, 3> key = {point.x(), point.y(), point.z()};
    const auto [found, is_new] = index_.emplace(key, static_cast<int>(mesh_.points.size()));
    if (is_new) mesh_.points.push_back(point);
    return found->second;
  }

 private:
  Mesh& mesh_;
  std::map<std::array<double, 3>, int> index_;
};

void require_few(std::size_t triangles, const std::string& file) {
  core::require_input(triangles <= most_triangles, file + ": more than " + std::to_string(most_triangles) +
                                                       " triangles; reduce them in a mesh editor");
}

void require_finite(const core::Vec3& point, const std::string& where) {
  core::require_input(point.allFinite(), where + ": a point is not finite; correct it");
}

constexpr std::size_t stl_header = 84, stl_triangle = 50;

std::uint32_t stl_count(const std::string& bytes) {
  std::uint32_t count = 0;
  if (bytes.size() >= stl_header) std::memcpy(&count, bytes.data() + 80, sizeof count);
  return count;
}

Mesh read_binary_stl(const std::string& bytes, const std::string& file) {
  core::require_input(bytes.size() >= stl_header, file + ": not an STL, whose header alone takes " +
                                                      std::to_string(stl_header) + " bytes; write it anew");
  const std::size_t count = stl_count(bytes), needed = stl_header + stl_triangle * count;
  core::require_input(bytes.size() >= needed, file + ": truncated: its " + std::to_string(count) +
                                                  " triangles take " + std::to_string(needed) +
                                                  " bytes, and it has " + std::to_string(bytes.size()) +
                                                  "; copy it anew");
  require_few(count, file);
  Mesh mesh;
  PointIndex index(mesh);
  for (std::size_t i = 0; i < count; ++i) {
    std::array<float, 9> at{};
    constexpr std::size_t normal_bytes = 12;
    std::memcpy(at.data(), bytes.data() + stl_header + stl_triangle * i + normal_bytes, sizeof at);
    std::array<int, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      const core::Vec3 point(at[3 * k], at[3 * k + 1], at[3 * k + 2]);
      require_finite(point, file + ": triangle " + std::to_string(i + 1));
      corners[k] = index.of(point);
    }
    mesh.triangles.push_back(corners);
  }
  return mesh;
}

/// The words of a text, line by line.
class Lines {
 public:
  Lines(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  bool next() {
    if (text_.empty()) return false;
    ++number_;
    const std::size_t end = std::min(text_.find('\n'), text_.size());
    std::string_view line = text_.substr(0, end);
    text_.remove_prefix(std::min(end + 1, text_.size()));
    words_.clear();
    for (std::size_t at = 0; at < line.size();) {
      const std::size_t first = line.find_first_not_of(" \t\r", at);
      if (first == std::string_view::npos) break;
      const std::size_t last = std::min(line.find_first_of(" \t\r", first), line.size());
      words_.push_back(line.substr(first, last - first));
      at = last;
    }
    return true;
  }

  const std::vector<std::string_view>& words() const { return words_; }
  bool begins_with(std::string_view word) const { return !words_.empty() && words_[0] == word; }
  std::string where() const { return file_ + ":" + std::to_string(number_); }
  [[noreturn]] void fail(const std::string& problem) const {
    throw core::InputError(where() + ": " + problem);
  }

  core::Vec3 point() const {
    if (words_.size() < 4) fail("a point needs three numbers");
    core::Vec3 at;
    for (int k = 0; k < 3; ++k) {
      std::string_view word = words_[static_cast<std::size_t>(k) + 1];
      if (word.starts_with('+')) word.remove_prefix(1);
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), at[k]);
      if (error != std::errc() || end != word.data() + word.size())
        fail(core::in_quotes(std::string(word)) + " is not a number; correct it");
    }
    require_finite(at, where());
    return at;
  }

 private:
  std::string_view text_;
  const std::string& file_;
  std::vector<std::string_view> words_;
  int number_ = 0;
};

Mesh read_text_stl(const std::string& text, const std::string& file) {
  Mesh mesh;
  PointIndex index(mesh);
  std::vector<int> corners;
  for (Lines line(text, file); line.next();) {
    if (line.begins_with("vertex")) {
      corners.push_back(index.of(line.point()));
    } else if (line.begins_with("endfacet")) {
      if (corners.size() != 3) line.fail("a facet needs three vertices; correct it");
      mesh.triangles.push_back({corners[0], corners[1], corners[2]});
      require_few(mesh.triangles.size(), file);
      corners.clear();
    }
  }
  core::require_input(corners.empty(), file + ": truncated: its last facet has no end; copy it anew");
  return mesh;
}

/// The index in "7", "7/1", "7//3" or "-1", which counts from the last point.
int corner_of(std::string_view word, std::size_t num_points, const Lines& line) {
  const std::string_view number = word.substr(0, word.find('/'));
  long index = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), index);
  const long count = static_cast<long>(num_points);
  if (index < 0) index += count + 1;
  if (error != std::errc() || end != number.data() + number.size() || index < 1 || index > count)
    line.fail("there is no point " + core::in_quotes(std::string(word)) + "; correct the face");
  return static_cast<int>(index - 1);
}

Mesh read_obj(const std::string& text, const std::string& file) {
  Mesh mesh;
  std::vector<int> index_of;  // by the number in the file
  PointIndex index(mesh);
  for (Lines line(text, file); line.next();) {
    if (line.begins_with("v")) {
      index_of.push_back(index.of(line.point()));
    } else if (line.begins_with("f")) {
      if (line.words().size() < 4) line.fail("a face needs three corners; correct it");
      std::vector<int> corners;
      for (std::size_t i = 1; i < line.words().size(); ++i) {
        const int at = corner_of(line.words()[i], index_of.size(), line);
        corners.push_back(index_of[static_cast<std::size_t>(at)]);
      }
      for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        mesh.triangles.push_back({corners[0], corners[i], corners[i + 1]});
      require_few(mesh.triangles.size(), file);
    }
  }
  return mesh;
}

}  // namespace

bool is_mesh_file(const std::string& path) { return ends_in(path, ".stl") || ends_in(path, ".obj"); }

Mesh read_mesh(const std::string& bytes, const std::string& file) {
  Mesh mesh;
  if (ends_in(file, ".obj")) {
    mesh = read_obj(bytes, file);
  } else {
    // A binary header may begin with the word by which the text is known.
    const bool is_binary = bytes.size() == stl_header + stl_triangle * stl_count(bytes);
    const bool is_text = !is_binary && bytes.starts_with("solid") && bytes.find("facet") != std::string::npos;
    mesh = is_text ? read_text_stl(bytes, file) : read_binary_stl(bytes, file);
  }
  core::require_input(!mesh.points.empty(), file + ": there are no triangles in it; write it anew");
  return mesh;
}

}  // namespace pbmpi::scenes
