#include "app/oni_command.hpp"

#include <cstdio>
#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "oni/check.hpp"
#include "oni/info.hpp"
#include "oni/repair.hpp"

namespace saccade {
namespace {

using Json = nlohmann::ordered_json;

// Names in a damaged file may hold any bytes; JSON and a terminal want text.
std::string printable(std::string text) {
  for (char& c : text)
    if (c < 32 || c > 126) c = '?';
  return text;
}

Json stream_json(const OniStreamInfo& stream) {
  Json json = {{"type", to_string(stream.type)},
               {"codec", to_string(stream.codec)},
               {"width", stream.size.width},
               {"height", stream.size.height},
               {"frames", stream.frames},
               {"pixels", stream.pixels},
               {"duration_s", stream.duration_s()},
               {"first_us", stream.first_us},
               {"last_us", stream.last_us},
               {"rate_hz", stream.nominal_rate_hz},
               {"measured_rate_hz", stream.measured_rate_hz},
               {"gaps", stream.gaps},
               {"largest_gap_us", stream.largest_gap_us},
               {"backward_steps", stream.backward_steps},
               {"dropped", stream.dropped},
               {"payload_bytes", stream.payload_bytes},
               {"node", stream.node},
               {"name", printable(stream.name)}};
  if (stream.crop.size() != stream.size)
    json["crop"] = {stream.crop.x, stream.crop.y, stream.crop.width, stream.crop.height};
  if (stream.intrinsics) {
    const Intrinsics& camera = *stream.intrinsics;
    json["intrinsics"] = {{"fx", camera.fx},
                          {"fy", camera.fy},
                          {"cx", camera.cx},
                          {"cy", camera.cy},
                          {"origin", to_string(camera.origin)}};
  }
  if (stream.unusable) json["unusable"] = *stream.unusable;
  return json;
}

void print_stream(const OniStreamInfo& stream) {
  fmt::print("  {:<6} {:<4} {} x {}, {}, {} frame{}, {:.2f} s", to_string(stream.type),
             to_string(stream.codec), stream.size.width, stream.size.height,
             stream.unusable ? "unusable: " + *stream.unusable : stream.pixels, stream.frames,
             stream.frames == 1 ? "" : "s", stream.duration_s());
  if (stream.measured_rate_hz > 0) fmt::print(", {:.2f}/s", stream.measured_rate_hz);
  if (stream.nominal_rate_hz > 0) fmt::print(" (nominal {:g})", stream.nominal_rate_hz);
  if (stream.gaps > 0)
    fmt::print(", {} gap{} up to {:.3f} s", stream.gaps, stream.gaps == 1 ? "" : "s",
               static_cast<double>(stream.largest_gap_us) / 1e6);
  if (stream.dropped > 0) fmt::print(", {} dropped while recording", stream.dropped);
  if (stream.intrinsics)
    fmt::print(", fx {:.2f} fy {:.2f} cx {:.2f} cy {:.2f} ({})", stream.intrinsics->fx, stream.intrinsics->fy,
               stream.intrinsics->cx, stream.intrinsics->cy, to_string(stream.intrinsics->origin));
  fmt::print("\n");
}

// Output that did not arrive, for example on a full disk, is a failure.
void flush_output() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    throw failed("cannot write", "standard output", "is the disk full?");
}

}  // namespace

void oni_info(const std::string& file, bool json) {
  const OniInfo info = describe(Recording(std::filesystem::path(file)));
  if (json) {
    Json out = {{"file", file},          {"bytes", info.size_bytes},      {"version", info.version},
                {"closed", info.closed}, {"lost_bytes", info.lost_bytes}, {"errors", info.errors}};
    out["streams"] = Json::array();
    for (const OniStreamInfo& stream : info.streams) out["streams"].push_back(stream_json(stream));
    fmt::print("{}\n", out.dump(-1, ' ', false, Json::error_handler_t::replace));
  } else {
    fmt::print("{}: {} bytes, version {}{}{}\n", file, info.size_bytes, info.version,
               info.closed ? "" : ", not closed",
               info.errors > 0 ? fmt::format(", {} problems (see oni check)", info.errors) : "");
    for (const OniStreamInfo& stream : info.streams) print_stream(stream);
  }
  flush_output();
}

void oni_check(const std::string& file, bool json) {
  Recording recording{std::filesystem::path(file)};
  const OniProblems problems = check_recording(recording);
  const bool sound = is_sound(problems);
  if (json) {
    Json out = {{"file", file},
                {"sound", sound},
                {"errors", problems.count(OniSeverity::error)},
                {"warnings", problems.count(OniSeverity::warning)}};
    out["problems"] = Json::array();
    for (const OniProblem& problem : problems.list())
      out["problems"].push_back({{"position", problem.position},
                                 {"severity", to_string(problem.severity)},
                                 {"meaning", printable(problem.meaning)}});
    fmt::print("{}\n", out.dump(-1, ' ', false, Json::error_handler_t::replace));
  } else {
    for (const OniProblem& problem : problems.list())
      fmt::print("{:>12}  {:<7}  {}\n", problem.position, to_string(problem.severity),
                 printable(problem.meaning));
    if (sound) fmt::print("{}: sound\n", file);
  }
  flush_output();
  if (!sound)
    throw unreadable(fmt::format("the recording is not sound, {} errors", problems.count(OniSeverity::error)),
                     file, "saccade oni repair saves what is whole");
}

void oni_repair(const std::string& file, const std::string& name, bool force, bool json) {
  const std::string to =
      name.empty() ? std::filesystem::path(file).replace_extension(".repaired.oni").string() : name;
  const OniRepairReport report = repair_recording(file, to, force);
  if (json) {
    const Json out = {{"file", file},
                      {"repaired", to},
                      {"frames", report.frames},
                      {"bad_frames", report.bad_frames},
                      {"lost_bytes", report.lost_bytes},
                      {"notes", report.notes}};
    fmt::print("{}\n", out.dump(-1, ' ', false, Json::error_handler_t::replace));
  } else {
    for (const std::string& note : report.notes) fmt::print("{}\n", note);
    fmt::print("{}: {} frames saved, {} bad frames left out, {} bytes were no records\n", to, report.frames,
               report.bad_frames, report.lost_bytes);
  }
  flush_output();
}

void add_oni_command(CLI::App& app, std::function<void()>& action) {
  struct Arguments {
    std::string file, to;
    bool json = false, force = false;
  };
  const auto a = std::make_shared<Arguments>();
  CLI::App& oni = *app.add_subcommand("oni", "look into, verify or mend an .oni recording");
  oni.require_subcommand(1);
  const auto add = [&](const char* name, const char* help) {
    CLI::App& command = *oni.add_subcommand(name, help);
    command.add_option("FILE", a->file, "the recording")->required();
    command.add_flag("--json", a->json, "the result in JSON on standard output");
    return &command;
  };
  add("info", "streams, sizes, codecs, frames, duration, rates, gaps, camera")->callback([a, &action] {
    action = [a] { oni_info(a->file, a->json); };
  });
  add("check", "every problem with its position; exit status 0 if the recording is sound, else 3")
      ->callback([a, &action] { action = [a] { oni_check(a->file, a->json); }; });
  CLI::App* repair = add("repair", "copy every good frame to a new, sound file");
  repair->add_option("TO,--out", a->to, "the file to make; FILE with .repaired.oni if it is not given");
  repair->add_flag("--force", a->force, "replace TO if it exists");
  repair->callback([a, &action] { action = [a] { oni_repair(a->file, a->to, a->force, a->json); }; });
}

}  // namespace saccade
