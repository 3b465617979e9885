#include "core/input_settings.hpp"

#include <string>

namespace saccade {
namespace {

void parse_depth_unit(InputSettings& s, const std::string& text) {
  constexpr double kSmallest = 1e-6, kLargest = 1e4;
  const std::string expected =
      "mm of one unit, 0.000001..10000, or 0 for that of the source (1mm and 100um are of record's "
      "--stored-unit)";
  const double unit = parse_number(text, 0.0, kLargest, expected);
  if (unit != 0 && unit < kSmallest) throw std::invalid_argument(expected);
  s.depth_unit_mm = unit;
}

// "depth=/a,colour=/b,camera=/c", in any order, each at most once.
void parse_topics(InputSettings& s, const std::string& text) {
  const std::string expected = "a list of depth=TOPIC, colour=TOPIC and camera=TOPIC, or nothing";
  s.depth_topic.clear();
  s.colour_topic.clear();
  s.camera_topic.clear();
  if (text.empty()) return;
  for (const std::string& part : split_list(text)) {
    const auto sign = part.find('=');
    if (sign == std::string::npos || sign + 1 == part.size()) throw std::invalid_argument(expected);
    const std::string key = part.substr(0, sign);
    std::string* topic = key == "depth"    ? &s.depth_topic
                         : key == "colour" ? &s.colour_topic
                         : key == "camera" ? &s.camera_topic
                                           : nullptr;
    if (topic == nullptr || !topic->empty()) throw std::invalid_argument(expected);
    *topic = part.substr(sign + 1);
  }
}

std::string print_topics(const InputSettings& s) {
  std::string text;
  const auto add = [&](const char* key, const std::string& topic) {
    if (!topic.empty()) text += (text.empty() ? "" : ",") + std::string(key) + "=" + topic;
  };
  add("depth", s.depth_topic);
  add("colour", s.colour_topic);
  add("camera", s.camera_topic);
  return text;
}

}  // namespace

std::vector<SettingOf<InputSettings>> input_setting_specs() {
  return {
      {"depth-unit", "MM", "mm of one unit of the source's stored depth; 0 = as the source says",
       parse_depth_unit, [](const InputSettings& s) { return print_number(s.depth_unit_mm); }},
      {"topics", "LIST", "topics of a bag, e.g. depth=/a,colour=/b,camera=/c; without it, by type and name",
       parse_topics, print_topics},
  };
}

}  // namespace saccade
