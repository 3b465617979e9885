// write_depth SOURCE FILE.png: the depth of the source's first frame, 16 bits, mm.
#include <opencv2/imgcodecs.hpp>
#include <saccade/sources/open_source.hpp>

int main(int, char** argv) {
  saccade::Frame frame;
  const auto source = saccade::open_source(argv[1]);
  if (source->read(frame, std::chrono::seconds(1)).status != saccade::ReadStatus::frame) return 1;
  cv::Mat depth;
  frame.depth_mm.convertTo(depth, CV_16U);
  return cv::imwrite(argv[2], depth) ? 0 : 1;
}
