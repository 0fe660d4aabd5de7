#include "scenes/xml/attributes.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

#include "core/error.h"
#include "core/quantity.h"
#include "core/text.h"

namespace pbmpi::scenes::xml {
namespace {

constexpr std::string_view blanks = " \t\r\n";

std::vector<std::string_view> words_in(std::string_view text) {
  std::vector<std::string_view> words;
  for (std::size_t at = text.find_first_not_of(blanks); at != std::string_view::npos;
       at = text.find_first_not_of(blanks, at)) {
    const std::size_t end = std::min(text.find_first_of(blanks, at), text.size());
    words.push_back(text.substr(at, end - at));
    at = end;
  }
  return words;
}

std::string trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(blanks) - first + 1));
}

/// "geom 'floor'", or "geom" without a name.
std::string title_of(const Element& element) {
  const Attribute* name = element.find("name");
  return name == nullptr ? element.name : element.name + " " + core::in_quotes(name->value);
}

}  // namespace

Attributes::Attributes(const Element& element, const std::vector<Attribute>& defaults)
    : what_(title_of(element)), where_(element.where), attributes_(element.attributes) {
  for (const Attribute& attribute : defaults) {
    if (peek(attribute.name) == nullptr) attributes_.push_back(attribute);
  }
}

void Attributes::drop(const LeaveOut& leave_out) {
  std::erase_if(attributes_,
                [&](const Attribute& attribute) { return leave_out.drops(attribute.name, attribute.where); });
}

bool Attributes::has(std::string_view name) { return find(name) != nullptr; }

std::string Attributes::text(std::string_view name, const std::optional<std::string>& fallback) {
  const Attribute* attribute = find(name);
  if (attribute != nullptr) return trimmed(attribute->value);
  if (!fallback) fail("it has no " + core::in_quotes(name) + "; give one");
  return *fallback;
}

double Attributes::number(std::string_view name, Range range, std::optional<double> fallback) {
  const std::vector<double> values = numbers(name, 1, 1);
  if (values.empty() && !fallback) fail("it has no " + core::in_quotes(name) + "; give a number");
  const double value = values.empty() ? *fallback : values.front();
  if (range == Range::positive && !(value > 0)) fail(name, core::in_quotes(name) + " must be above 0");
  if (const std::string_view bound = core::bound_against(value, range == Range::positive); !bound.empty())
    fail(name,
         core::in_quotes(name) + " is " + core::number_text(value) + "; it must be " + std::string(bound));
  if (range == Range::non_negative && !(value >= 0))
    fail(name, core::in_quotes(name) + " must be at least 0");
  return value;
}

int Attributes::integer(std::string_view name, int least, int fallback) {
  const double value = number(name, Range::any, fallback);
  constexpr double most = 2147483647;
  if (value != std::floor(value) || value < least || value > most)
    fail(name, core::in_quotes(name) + " must be a whole number from " + std::to_string(least) + " on");
  return static_cast<int>(value);
}

std::vector<double> Attributes::numbers(std::string_view name, std::size_t least, std::size_t most) {
  const Attribute* attribute = find(name);
  if (attribute == nullptr) return {};
  const std::vector<std::string_view> words = words_in(attribute->value);
  if (words.size() < least || words.size() > most) {
    const std::string wanted =
        least == most ? std::to_string(least) : std::to_string(least) + " to " + std::to_string(most);
    fail(name,
         core::in_quotes(name) + " has " + std::to_string(words.size()) + " numbers instead of " + wanted);
  }
  std::vector<double> values;
  values.reserve(words.size());
  for (const std::string_view word : words) values.push_back(to_number(*attribute, word));
  return values;
}

core::Vec3 Attributes::vector(std::string_view name, const std::optional<core::Vec3>& fallback) {
  const std::vector<double> values = numbers(name, 3, 3);
  if (values.empty() && !fallback) fail("it has no " + core::in_quotes(name) + "; give three numbers");
  return values.empty() ? *fallback : core::Vec3(values[0], values[1], values[2]);
}

core::Vec3 Attributes::direction(std::string_view name, const core::Vec3& fallback) {
  const core::Vec3 value = vector(name, fallback);
  const double largest = value.cwiseAbs().maxCoeff();
  if (!(largest > 0)) fail(name, core::in_quotes(name) + " is zero and has no direction");
  return (value / largest).normalized();
}

core::Quat Attributes::turn(std::string_view name, bool real_last) {
  std::vector<double> q = numbers(name, 4, 4);
  if (real_last) std::rotate(q.begin(), q.end() - 1, q.end());
  const Eigen::Quaterniond value(q[0], q[1], q[2], q[3]);
  if (!(value.norm() > 0))
    fail(name, core::in_quotes(name) + " is zero and turns nothing; give a quaternion that is not");
  return core::Quat::from_eigen(value.normalized());
}

bool Attributes::flag(std::string_view name, bool fallback) {
  return word(name, {"true", "false"}, fallback ? "true" : "false") == "true";
}

std::string Attributes::word(std::string_view name, std::initializer_list<std::string_view> words,
                             std::string_view fallback) {
  std::string value = text(name, std::string(fallback));
  if (std::ranges::find(words, value) != words.end()) return value;
  fail(name, core::in_quotes(name) + " cannot be " + core::in_quotes(value) +
                 core::suggestion(value, {words.begin(), words.end()}));
}

void Attributes::allow(std::initializer_list<std::string_view> names) {
  known_.insert(known_.end(), names.begin(), names.end());
}

void Attributes::refuse(std::initializer_list<std::string_view> names, const std::string& problem) {
  for (const std::string_view name : names) {
    if (has(name)) fail_unless_left_out(name, core::in_quotes(name) + ": " + problem);
  }
}

void Attributes::finish() const {
  for (const Attribute* attribute : unknown()) fail_unknown(*attribute, known_);
}

void Attributes::finish(Notes& notes) const {
  std::vector<std::string> missing;
  for (const std::string& name : known_) {
    if (peek(name) == nullptr) missing.push_back(name);
  }
  for (const Attribute* attribute : unknown()) {
    if (!core::nearest_name(attribute->name, missing).empty()) fail_unknown(*attribute, missing);
    notes.add(attribute->where,
              "the attribute " + core::in_quotes(attribute->name) + " is unknown, and left out");
  }
}

std::vector<const Attribute*> Attributes::unknown() const {
  std::vector<const Attribute*> found;
  for (const Attribute& attribute : attributes_) {
    const bool is_of_xml = attribute.name == "xmlns" || attribute.name.find(':') != std::string::npos;
    if (!is_of_xml && std::ranges::find(known_, attribute.name) == known_.end()) found.push_back(&attribute);
  }
  return found;
}

void Attributes::fail_unknown(const Attribute& attribute, const std::vector<std::string>& names) const {
  fail(attribute.name, "unknown attribute " + core::in_quotes(attribute.name) + "; take another, or " +
                           LeaveOut::advice(attribute.name) + core::suggestion(attribute.name, names));
}

std::string Attributes::where(std::string_view name) const {
  const Attribute* attribute = peek(name);
  return attribute == nullptr ? where_ : attribute->where;
}

void Attributes::fail(const std::string& problem) const {
  throw core::InputError(where_ + ": " + what_ + ": " + problem);
}

void Attributes::fail(std::string_view name, const std::string& problem) const {
  throw core::InputError(where(name) + ": " + what_ + ": " + problem);
}

void Attributes::fail_unless_left_out(std::string_view name, const std::string& problem,
                                      std::string_view left_out) const {
  fail(name, problem + ", or " + LeaveOut::advice(left_out.empty() ? name : left_out));
}

void refuse_element(const Element& element, const std::string& problem) {
  Attributes(element).fail(problem + ", or " + LeaveOut::advice(element.name));
}

const Attribute* Attributes::find(std::string_view name) {
  if (std::ranges::find(known_, name) == known_.end()) known_.emplace_back(name);
  return peek(name);
}

const Attribute* Attributes::peek(std::string_view name) const {
  const auto found = std::ranges::find(attributes_, name, &Attribute::name);
  return found == attributes_.end() ? nullptr : &*found;
}

double Attributes::to_number(const Attribute& attribute, std::string_view word) const {
  const bool has_plus = word.starts_with('+') && !word.starts_with("+-");
  const std::string_view digits = has_plus ? word.substr(1) : word;
  double value = 0;
  const char* const end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value))
    fail(attribute.name, core::in_quotes(word) + " is not a finite number");
  if (const std::string_view bound = core::bound_against(value, false); !bound.empty())
    fail(attribute.name,
         core::in_quotes(attribute.name) + " is " + std::string(word) + "; it must be " + std::string(bound));
  return value;
}

}  // namespace pbmpi::scenes::xml
