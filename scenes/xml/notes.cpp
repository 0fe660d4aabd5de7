#include "scenes/xml/notes.h"

namespace pbmpi::scenes::xml {

void Notes::add(const std::string& where, const std::string& text) {
  const auto [at, is_new] = index_.emplace(text, notes_.size());
  if (is_new) notes_.push_back({where, text, 0});
  ++notes_[at->second].count;
}

std::vector<std::string> Notes::lines() const {
  std::vector<std::string> lines;
  for (const Note& note : notes_) {
    const std::string more = note.count == 1 ? "" : " (and " + std::to_string(note.count - 1) + " more)";
    lines.push_back(note.where + ": " + note.text + more);
  }
  return lines;
}

}  // namespace pbmpi::scenes::xml
