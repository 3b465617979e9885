#pragma once

#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace saccade {

/// Opens /dev/null for each of the descriptors 0, 1 and 2 that is closed, as in `saccade ... >&-` and in some
/// services. Otherwise the next file that is opened would get that number, and messages would be written into
/// it. Call it first in main().
void open_standard_streams();

/// Whether the reader of standard output may close a pipe before the end, as head does with a page of help.
/// Who reads the result of some work should get it all.
enum class Reader { stays, may_leave };

/// Print on standard output, at once. Throw Error (failed) if that cannot be written, e.g. on a full disk.
/// Characters of `text` that cannot be printed are escaped, except line breaks.
void print_text(std::string_view text, Reader reader = Reader::stays);
/// A value, as by dump(), and a line break.
void print_json(const nlohmann::ordered_json& json, int indent = -1);

}  // namespace saccade
