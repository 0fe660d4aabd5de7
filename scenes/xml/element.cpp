#include "scenes/xml/element.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include <pugixml.hpp>

#include "core/error.h"
#include "core/text.h"

namespace pbmpi::scenes::xml {
namespace {

/// Lines and columns of a text that the parser changes in place: names stay at their positions.
class Places {
 public:
  Places(std::string_view text, const std::string& file) : file_(file), size_(text.size()) {
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] == '\n') line_starts_.push_back(i + 1);
    }
  }

  std::string at(std::size_t offset) const {
    offset = std::min(offset, size_);
    const auto after = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
    const auto line = after - line_starts_.begin();
    const std::size_t column = offset - *(after - 1) + 1;
    return file_ + ":" + std::to_string(line) + ":" + std::to_string(column);
  }

 private:
  std::string file_;
  std::size_t size_;
  std::vector<std::size_t> line_starts_{0};
};

class Reader {
 public:
  Reader(std::string_view text, const std::string& file) : buffer_(text), places_(text, file) {
    const std::size_t end = text.find('\0');
    core::require_input(end == std::string_view::npos,
                        places_.at(end) + ": a zero byte; is this a text file?");
  }

  Element root() {
    pugi::xml_document document;
    const pugi::xml_parse_result result = document.load_buffer_inplace(
        buffer_.data(), buffer_.size(), pugi::parse_default, pugi::encoding_utf8);
    core::require_input(result.status != pugi::status_no_document_element, places_.at(0) + ": no element");
    core::require_input(result,
                        places_.at(static_cast<std::size_t>(std::max<std::ptrdiff_t>(result.offset, 0))) +
                            ": malformed XML: " + result.description());
    const pugi::xml_node first = document.document_element();
    for (pugi::xml_node node = first.next_sibling(); node; node = node.next_sibling()) {
      core::require_input(node.type() != pugi::node_element,
                          where(node.name()) + ": a second root element; a file has one");
    }
    return read(first, 0);
  }

 private:
  std::string where(const char* name) const {
    return places_.at(static_cast<std::size_t>(name - buffer_.data()));
  }

  Element read(const pugi::xml_node& node, int depth) const {
    Element element;
    element.name = node.name();
    element.where = where(node.name());
    core::require_input(depth < most_nesting, element.where + ": more than " + std::to_string(most_nesting) +
                                                  " elements lie in each other; make the tree flatter");
    for (const pugi::xml_attribute attribute : node.attributes()) {
      core::require_input(!element.find(attribute.name()),
                          where(attribute.name()) + ": '" + attribute.name() + "' stands here twice");
      element.attributes.push_back({attribute.name(), attribute.value(), where(attribute.name())});
    }
    for (const pugi::xml_node child : node.children()) {
      if (child.type() == pugi::node_element) element.children.push_back(read(child, depth + 1));
    }
    return element;
  }

  std::string buffer_;
  Places places_;
};

}  // namespace

const Attribute* Element::find(std::string_view attribute) const {
  const auto found = std::ranges::find(attributes, attribute, &Attribute::name);
  return found == attributes.end() ? nullptr : &*found;
}

bool is_xml(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && text[first] == '<';
}

Element parse(std::string_view text, const std::string& file) { return Reader(text, file).root(); }

}  // namespace pbmpi::scenes::xml
