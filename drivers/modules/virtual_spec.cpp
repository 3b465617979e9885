#include "drivers/modules/virtual_spec.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "core/error.hpp"
#include "sources/source_kind.hpp"

namespace saccade {
namespace {

using std::string_view;

template <typename Number>
std::optional<Number> number(string_view text, Number low, Number high) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !(value >= low && value <= high))
    return std::nullopt;
  return value;
}

std::optional<std::int64_t> count(string_view text) { return number<std::int64_t>(text, 1, 1'000'000'000); }

std::optional<std::chrono::milliseconds> duration(string_view text) {
  const auto ms = number<std::int64_t>(text, 0, 86'400'000);
  if (!ms) return std::nullopt;
  return std::chrono::milliseconds(*ms);
}

// Stores the value if there is one; false otherwise.
template <typename Value, typename Target>
bool store(const std::optional<Value>& value, Target& target) {
  if (value) target = *value;
  return value.has_value();
}

bool read_loss(string_view text, VirtualSpec& spec) {
  constexpr std::array<string_view, 3> kNames = {"event", "state", "silent"};
  const auto found = std::find(kNames.begin(), kNames.end(), text);
  if (found == kNames.end()) return false;
  spec.loss = static_cast<VirtualSpec::Loss>(found - kNames.begin());
  return true;
}

struct Key {
  string_view name, expects;
  bool (*read)(string_view, VirtualSpec&);  // false: another value than expected
};

constexpr string_view kCount = "a number of frames, 1..1000000000";
constexpr string_view kDuration = "integer ms, 0..86400000";

constexpr std::array<Key, 10> kKeys = {{
    {"loss_after", kCount, [](string_view v, VirtualSpec& s) { return store(count(v), s.loss_after); }},
    {"loss", "event, state or silent", read_loss},
    {"back_after_ms", kDuration,
     [](string_view v, VirtualSpec& s) { return store(duration(v), s.back_after); }},
    {"back_at", "the number of a frame, 0..1000000000",
     [](string_view v, VirtualSpec& s) {
       return store(number<std::int64_t>(v, 0, 1'000'000'000), s.back_at);
     }},
    {"late_ms", kDuration, [](string_view v, VirtualSpec& s) { return store(duration(v), s.late); }},
    {"stall_ms", kDuration, [](string_view v, VirtualSpec& s) { return store(duration(v), s.stall); }},
    {"stall_after", kCount, [](string_view v, VirtualSpec& s) { return store(count(v), s.stall_after); }},
    {"short_frame", kCount, [](string_view v, VirtualSpec& s) { return store(count(v), s.short_frame); }},
    {"rate", "Hz, 0.1..1000",
     [](string_view v, VirtualSpec& s) { return store(number<double>(v, 0.1, 1000), s.rate_hz); }},
    {"ignores_settings", "0 or 1",
     [](string_view v, VirtualSpec& s) { return store(number<int>(v, 0, 1), s.ignores_settings); }},
}};

std::string known_keys() {
  std::string names;
  for (const Key& key : kKeys) names += (names.empty() ? "" : ", ") + std::string(key.name);
  return names;
}

// Takes a pair if its key is the device's; false if it is not.
bool take_pair(string_view pair, const std::string& text, std::set<string_view>& seen, VirtualSpec& spec) {
  const auto equals = pair.find('=');
  const auto key = std::find_if(kKeys.begin(), kKeys.end(),
                                [&](const Key& k) { return k.name == pair.substr(0, equals); });
  if (key == kKeys.end()) return false;
  if (!seen.insert(key->name).second)
    throw usage_error(fmt::format("key '{}' is given twice", key->name), text, "give it once");
  const string_view value = equals == string_view::npos ? string_view() : pair.substr(equals + 1);
  if (!key->read(value, spec))
    throw usage_error(fmt::format("bad value '{}' of key '{}'", value, key->name), text,
                      fmt::format("expected: {}", key->expects));
  return true;
}

}  // namespace

VirtualSpec parse_virtual(const std::string& text) {
  const auto separator = std::min(text.find_first_of("?&"), text.size());
  VirtualSpec spec;
  spec.source = text.substr(0, separator);
  const bool has_own_keys = spec.source.starts_with("synthetic:");
  std::set<string_view> seen;
  char before = '?';
  for (auto begin = separator; begin < text.size();) {
    const auto end = std::min(text.find('&', begin + 1), text.size());
    const string_view pair = string_view(text).substr(begin + 1, end - begin - 1);
    if (!take_pair(pair, text, seen, spec)) {
      if (!has_own_keys)
        throw usage_error(fmt::format("unknown key '{}'", pair.substr(0, pair.find('='))), text,
                          "known keys: " + known_keys());
      spec.source += before;
      spec.source += pair;
      before = '&';
    }
    begin = end;
  }
  if (spec.source.empty()) throw usage_error("no source is named", text, "SOURCE?key=value&... is expected");
  return spec;
}

std::string seen_from(const std::filesystem::path& folder, const std::string& source) {
  const SourceKind* kind = kind_of(SourceInput(source));
  return kind != nullptr && !kind->is_path ? source : (folder / source).lexically_normal().string();
}

}  // namespace saccade
