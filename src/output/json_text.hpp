#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace saccade {

/// A JSON value as text; `indent` as in nlohmann::json::dump(). Bytes that are not UTF-8, which names of
/// files may hold, are replaced.
std::string dump(const nlohmann::ordered_json& json, int indent = -1);

}  // namespace saccade
