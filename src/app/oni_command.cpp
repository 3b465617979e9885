#include "app/oni_command.hpp"

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/standard_output.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "oni/check.hpp"
#include "oni/info.hpp"
#include "oni/repair.hpp"

namespace saccade {
namespace {

using Json = nlohmann::ordered_json;

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

std::string to_text(const OniStreamInfo& stream) {
  std::string text = fmt::format("  {:<6} {:<4} {} x {}, {}, {}, {:.2f} s", to_string(stream.type),
                                 to_string(stream.codec), stream.size.width, stream.size.height,
                                 stream.unusable ? "unusable: " + *stream.unusable : stream.pixels,
                                 counted(stream.frames, "frame"), stream.duration_s());
  if (stream.measured_rate_hz > 0) text += fmt::format(", {:.2f}/s", stream.measured_rate_hz);
  if (stream.nominal_rate_hz > 0) text += fmt::format(" (nominal {:g})", stream.nominal_rate_hz);
  if (stream.gaps > 0)
    text += fmt::format(", {} up to {:.3f} s", counted(stream.gaps, "gap"),
                        static_cast<double>(stream.largest_gap_us) / 1e6);
  if (stream.dropped > 0) text += fmt::format(", {} dropped while recording", stream.dropped);
  if (stream.intrinsics)
    text += fmt::format(", fx {:.2f} fy {:.2f} cx {:.2f} cy {:.2f} ({})", stream.intrinsics->fx,
                        stream.intrinsics->fy, stream.intrinsics->cx, stream.intrinsics->cy,
                        to_string(stream.intrinsics->origin));
  return text + "\n";
}

}  // namespace

void oni_info(const std::string& file, bool json) {
  const OniInfo info = describe(Recording(std::filesystem::path(file)));
  if (json) {
    Json out = {{"file", file},          {"bytes", info.size_bytes},      {"version", info.version},
                {"closed", info.closed}, {"lost_bytes", info.lost_bytes}, {"errors", info.errors}};
    out["streams"] = Json::array();
    for (const OniStreamInfo& stream : info.streams) out["streams"].push_back(stream_json(stream));
    print_json(out);
  } else {
    std::string text = fmt::format(
        "{}: {}, version {}{}{}\n", file, counted(info.size_bytes, "byte"), info.version,
        info.closed ? "" : ", not closed",
        info.errors > 0 ? fmt::format(", {} (see oni check)", counted(info.errors, "problem")) : "");
    for (const OniStreamInfo& stream : info.streams) text += to_text(stream);
    print_text(text);
  }
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
    print_json(out);
  } else {
    std::string text;
    for (const OniProblem& problem : problems.list())
      text += fmt::format("{:>12}  {:<7}  {}\n", problem.position, to_string(problem.severity),
                          printable(problem.meaning));
    if (sound) text += fmt::format("{}: sound\n", file);
    print_text(text);
  }
  if (!sound)
    throw unreadable(
        fmt::format("the recording is not sound, {}", counted(problems.count(OniSeverity::error), "error")),
        file, "saccade oni repair saves the good frames");
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
    print_json(out);
  } else {
    std::string text;
    for (const std::string& note : report.notes) text += printable(note) + "\n";
    text += fmt::format("{}: {} saved, {} left out, {} outside records skipped\n", to,
                        counted(report.frames, "frame"), counted(report.bad_frames, "bad frame"),
                        counted(report.lost_bytes, "byte"));
    print_text(text);
  }
}

void oni_cut(const std::string& file, const std::string& piece, const std::string& to, bool force,
             bool json) {
  OniPiece parsed;
  try {
    parsed = parse_piece(piece);
  } catch (const std::invalid_argument& expected) {
    throw usage_error("not a piece of a recording", piece, fmt::format("expected {}", expected.what()));
  }
  const OniRepairReport report = cut_recording(file, to, parsed, force);
  if (json)
    print_json(Json{{"file", file},
                    {"piece", piece},
                    {"to", to},
                    {"frames", report.frames},
                    {"bad_frames", report.bad_frames}});
  else
    print_text(fmt::format("{}: {} frames of all streams copied, {} bad frames left out\n", to, report.frames,
                           report.bad_frames));
}

void add_oni_command(CLI::App& app, std::function<void()>& action) {
  struct Arguments {
    std::string file, to, piece;
    bool json = false, force = false;
  };
  const auto a = std::make_shared<Arguments>();
  CLI::App& oni = *app.add_subcommand("oni", "inspect, check, repair or cut an .oni recording");
  oni.require_subcommand(1);
  const auto add = [&](const char* name, const char* help) {
    CLI::App& command = *oni.add_subcommand(name, help);
    command.add_option("FILE", a->file, "the recording")->required();
    command.add_flag("--json", a->json, "print JSON on standard output");
    return &command;
  };
  add("info", "list streams, sizes, codecs, frames, duration, rates, gaps, camera")->callback([a, &action] {
    action = [a] { oni_info(a->file, a->json); };
  });
  add("check", "list every problem with its position; exit status 0 if the recording is sound, else 3")
      ->callback([a, &action] { action = [a] { oni_check(a->file, a->json); }; });
  CLI::App* repair = add("repair", "copy every good frame to a new file");
  repair->add_option("TO,--out", a->to, "the new file; without it, FILE with the ending .repaired.oni");
  repair->add_flag("--force", a->force, "replace TO if it exists");
  repair->callback([a, &action] { action = [a] { oni_repair(a->file, a->to, a->force, a->json); }; });
  CLI::App* cut = add("cut", "copy a piece to a new file, bit for bit");
  cut->add_option("PIECE", a->piece, "FROM..TO, both included: frame numbers (10..20) or seconds (1.5s..3s)")
      ->required();
  cut->add_option("TO,--out", a->to, "the new file")->required();
  cut->add_flag("--force", a->force, "replace TO if it exists");
  cut->callback([a, &action] { action = [a] { oni_cut(a->file, a->piece, a->to, a->force, a->json); }; });
}

}  // namespace saccade
