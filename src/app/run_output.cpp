#include "app/run_output.hpp"

#include <string>
#include <utility>

#include "output/fixations_json.hpp"
#include "output/frame_writer.hpp"

namespace saccade {

int RunOutput::writers(const Settings& settings) {
  constexpr int kThreads = 2;
  return settings.dump.empty() ? 0 : kThreads;
}

RunOutput::RunOutput(const std::filesystem::path& folder, const Settings& settings, const SourceInfo& source,
                     LineFile::Existing lines, LineStream* stream)
    : dumps_dataset_(settings.dump.contains("depth")),
      stream_(stream),
      fixations_(folder / "fixations.jsonl", lines),
      dataset_(folder, source),
      writer_(writers(settings), [this, folder, &settings](const Result& result) {
        write_frame(folder, result, settings.dump, settings.first_level, dataset_, settings.overlay);
      }) {}

void RunOutput::add(ResultHandle result) {
  const std::string line = fixations_json(*result);
  fixations_.append(line);
  if (stream_ != nullptr) stream_->send(streamed_json(*result, line));
  if (dumps_dataset_) dataset_.add(result->frame);
  writer_.submit(std::move(result));
}

void RunOutput::finish() {
  if (stream_ != nullptr) stream_->finish();
  writer_.finish();
  dataset_.finish();
  fixations_.check_in_place();
}

}  // namespace saccade
