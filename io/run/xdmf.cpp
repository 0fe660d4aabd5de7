#include "io/run/xdmf.h"

#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/error.h"
#include "io/file/write_file.h"
#include "io/hdf5/read_columns.h"

namespace pbmpi::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* bodies = "/particles/bodies/";

/// The data of the run that the sidecar needs.
struct Bodies {
  std::string file;      ///< as written into the sidecar
  hsize_t num_rows = 0;  ///< extent in the file: longer than `times` in a killed run
  hsize_t count = 0;
  std::vector<double> times;  ///< of the committed rows [s]
};

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

Bodies read_bodies(const std::string& run_path, const std::string& xdmf_path) {
  const File file = open_run(run_path);
  try {
    const std::int64_t committed = integer_attribute(file.id(), "/", "frames_committed");
    const std::int64_t record_every = integer_attribute(file.id(), "/", "record_every");
    if (committed < 0 || record_every < 1) throw core::RunError("impossible root attributes");
    const auto dims = dims_of(file.id(), std::string(bodies) + "position/value");
    if (dims.size() != 3) throw core::RunError("/particles/bodies/position/value is not [rows][bodies][3]");
    const fs::path folder = fs::absolute(xdmf_path).parent_path();
    return {escaped(fs::absolute(run_path).lexically_proximate(folder).generic_string()), dims[0], dims[1],
            read_doubles(file.id(), std::string(bodies) + "position/time", committed / record_every, 1)};
  } catch (const core::RunError& error) {
    throw core::InputError(run_path + ": " + error.what() + "; the file is damaged or incomplete");
  }
}

/// Row `row` of an array [rows][bodies][width] of the run's file, given in two forms: ParaView's "XDMF
/// Reader" takes the hyperslab that the two children describe (it knows Type as well as ItemType), and its
/// Xdmf3 readers, which crash on an ItemType of HyperSlab, take the text "dataset|start:stride:count:extent".
void row_item(std::ostream& out, const Bodies& b, const std::string& name, int width, std::size_t row) {
  const std::string dataset = b.file + ":" + bodies + name;
  const std::string number = "\" NumberType=\"Float\" Precision=\"8\" Format=\"HDF\">";
  std::ostringstream items;
  items << b.count << ' ' << width;
  const std::string count = "1 " + items.str();
  const std::string extent = std::to_string(b.num_rows) + " " + items.str();
  const std::string start = std::to_string(row) + " 0 0";
  out << "<DataItem Type=\"HyperSlab\" Dimensions=\"" << items.str() << number << dataset << '|' << start
      << ":1 1 1:" << count << ':' << extent << "<DataItem Dimensions=\"3 3\" Format=\"XML\">" << start
      << " 1 1 1 " << count << "</DataItem><DataItem Dimensions=\"" << extent << number << dataset
      << "</DataItem></DataItem>";
}

void row_attribute(std::ostream& out, const Bodies& b, const std::string& name, int width, std::size_t row) {
  out << "    <Attribute Name=\"" << name << "\" Center=\"Node\" AttributeType=\""
      << (width == 3 ? "Vector" : "Matrix") << "\">";
  row_item(out, b, name + "/value", width, row);
  out << "</Attribute>\n";
}

/// Writes a column that does not change with time.
void fixed_attribute(std::ostream& out, const Bodies& b, const std::string& name, const char* number) {
  out << "    <Attribute Name=\"" << name
      << "\" Center=\"Node\" AttributeType=\"Scalar\"><DataItem Dimensions=\"" << b.count << "\" " << number
      << " Format=\"HDF\">" << b.file << ':' << bodies << name << "</DataItem></Attribute>\n";
}

void grid(std::ostream& out, const Bodies& b, std::size_t row) {
  out << "   <Grid Name=\"bodies\" GridType=\"Uniform\">\n    <Time Value=\"" << b.times[row]
      << "\"/>\n"
      // The connectivity, one point a cell, is 0, 1, 2 ...: the ids of the bodies.
      << "    <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"" << b.count
      << "\" NodesPerElement=\"1\"><DataItem Dimensions=\"" << b.count
      << "\" NumberType=\"Int\" Precision=\"8\" Format=\"HDF\">" << b.file << ':' << bodies
      << "id</DataItem></Topology>\n"
      << "    <Geometry GeometryType=\"XYZ\">";
  row_item(out, b, "position/value", 3, row);
  out << "</Geometry>\n";
  row_attribute(out, b, "velocity", 3, row);
  row_attribute(out, b, "angular_velocity", 3, row);
  row_attribute(out, b, "orientation", 4, row);
  fixed_attribute(out, b, "world", "NumberType=\"Int\" Precision=\"4\"");
  fixed_attribute(out, b, "id", "NumberType=\"Int\" Precision=\"8\"");
  fixed_attribute(out, b, "mass", "NumberType=\"Float\" Precision=\"8\"");
  out << "   </Grid>\n";
}

std::string document(const Bodies& b) {
  std::ostringstream out;
  out.precision(17);
  out << "<?xml version=\"1.0\"?>\n"
      << "<Xdmf Version=\"3.0\">\n <Domain>\n"
      << "  <Grid Name=\"run\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (std::size_t row = 0; row < b.times.size(); ++row) grid(out, b, row);
  out << "  </Grid>\n </Domain>\n</Xdmf>\n";
  return out.str();
}

/// Does an existing file show the bodies of another run, or is it no sidecar at all?
bool is_of_others(const std::string& run_path, const std::string& xdmf_path) {
  std::error_code ignored;
  if (fs::exists(xdmf_path, ignored) && !fs::is_regular_file(xdmf_path, ignored)) return true;
  std::ifstream file(xdmf_path, std::ios::binary);
  constexpr std::size_t enough = 4096;  // the first grid names the run
  std::string begin(enough, '\0');
  file.read(begin.data(), enough);
  begin.resize(static_cast<std::size_t>(file.gcount()));
  if (begin.empty()) return false;
  if (begin.find("<Xdmf") == std::string::npos) return true;
  return begin.find(bodies) != std::string::npos &&
         begin.find(fs::path(run_path).filename().string() + ":" + bodies) == std::string::npos;
}

}  // namespace

void write_sidecar(const std::string& run_path, const std::string& xdmf_path) {
  core::require_input(!is_of_others(run_path, xdmf_path),
                      xdmf_path + ": it is there, and not the sidecar of " + run_path +
                          "; remove it and use pbreport --xdmf");
  write_xdmf(run_path, xdmf_path);
}

void write_xdmf(const std::string& run_path, const std::string& xdmf_path) {
  write_file(xdmf_path, document(read_bodies(run_path, xdmf_path)));
}

}  // namespace pbmpi::io
