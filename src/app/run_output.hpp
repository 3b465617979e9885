#pragma once

#include <filesystem>
#include <memory>

#include "core/file.hpp"
#include "core/frame_source.hpp"
#include "output/dataset_writer.hpp"
#include "output/line_stream.hpp"
#include "output/writer_pool.hpp"
#include "pipeline/result.hpp"
#include "settings/settings.hpp"

namespace saccade {

/// What `saccade run` writes of its results: fixations.jsonl, the files of each frame that --dump names, and
/// the stream. The results are of a pipeline that outlives it. One thread; all functions throw Error
/// (failed).
class RunOutput {
 public:
  /// Pictures are written by threads of their own, this many, each of which holds a result.
  static int writers(const Settings& settings);

  /// `stream`: nullptr = none. With LineFile::Existing::keep, new lines of fixations.jsonl follow those
  /// there.
  RunOutput(const std::filesystem::path& folder, const Settings& settings, const SourceInfo& source,
            LineFile::Existing lines, LineStream* stream);

  /// In the order of the frames.
  void add(ResultHandle result);

  /// After the last result.
  void finish();

  /// Depth that was not stored exactly, so far.
  DepthLosses losses() const { return dataset_.losses(); }

 private:
  bool dumps_dataset_;
  LineStream* stream_;
  LineFile fixations_;
  DatasetWriter dataset_;
  WriterPool writer_;  // last, so that its threads end first
};

}  // namespace saccade
