#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <opencv2/core.hpp>

#include "app/commands.hpp"
#include "app/standard_output.hpp"
#include "core/error.hpp"
#include "core/text.hpp"

namespace {

using saccade::ExitStatus;

int report(std::string line, ExitStatus status) {
  std::ranges::replace(line, '\n', ' ');
  std::fprintf(stderr, "saccade: %s\n", saccade::printable(line).c_str());
  return static_cast<int>(status);
}

int report_out_of_memory() {
  return report("out of memory (try smaller images or fewer --workers)", ExitStatus::failed);
}

// A message for the log, which may hold names of files.
class PrintableMessage final : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm&, spdlog::memory_buf_t& out) override {
    const std::string text = saccade::printable({message.payload.data(), message.payload.size()});
    out.append(text.data(), text.data() + text.size());
  }
  std::unique_ptr<custom_flag_formatter> clone() const override {
    return std::make_unique<PrintableMessage>();
  }
};

void set_up_log() {
  spdlog::set_default_logger(spdlog::stderr_logger_mt("saccade"));
  auto formatter = std::make_unique<spdlog::pattern_formatter>();
  formatter->add_flag<PrintableMessage>('*').set_pattern("%n: %l: %*");
  spdlog::set_formatter(std::move(formatter));
}

}  // namespace

int main(int argc, char** argv) {
  saccade::open_standard_streams();
  // A file-size limit and a closed pipe then appear as a failed write, which is reported like a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  try {
    set_up_log();
    saccade::run_command_line(argc, argv);
    return static_cast<int>(ExitStatus::done);
  } catch (const saccade::Error& error) {
    return report(error.what(), error.status());
  } catch (const std::bad_alloc&) {
    return report_out_of_memory();
  } catch (const std::length_error&) {
    return report_out_of_memory();
  } catch (const cv::Exception& error) {
    if (error.code == cv::Error::StsNoMem) return report_out_of_memory();
    return report("unexpected: OpenCV: " + error.err, ExitStatus::failed);
  } catch (const std::filesystem::filesystem_error& error) {
    return report(error.code().message() + ": " + error.path1().string() + " (check its permissions)",
                  ExitStatus::failed);
  } catch (const std::system_error& error) {
    return report(std::string("the system refuses a thread or a lock: ") + error.code().message() +
                      " (is there enough memory? try fewer --workers)",
                  ExitStatus::failed);
  } catch (const std::exception& error) {
    return report(std::string("unexpected: ") + error.what(), ExitStatus::failed);
  }
}
