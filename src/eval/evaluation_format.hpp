#pragma once

namespace saccade {

/// Version of the format of results.jsonl and report.json (src/app/README.md, Versions).
inline constexpr int kEvaluationFormat = 4;

}  // namespace saccade
