// Stands in for libfreenect with what fakenect lacks: depth in mm and registered, infrared, flags, the
// geometry of the camera, and a Kinect that is unplugged and plugged in again. Depth is 1000 + k mm when
// registered, 2000 + k when not; the infrared 300 + k; k counts from 1. FAKE_KINECT_FRAMES=N: after N depth
// frames it is away for 1.5 s, once.
#include <libfreenect.h>
#include <libfreenect_registration.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <thread>
#include <vector>

namespace {

using Clock = std::chrono::steady_clock;

struct Fake {
  freenect_depth_cb on_depth = nullptr;
  freenect_video_cb on_video = nullptr;
  freenect_depth_format depth_format = FREENECT_DEPTH_MM;
  bool depth_runs = false, video_runs = false, was_lost = false;
  void* user = nullptr;
  std::uint16_t frames = 0;
  Clock::time_point back{};
  std::vector<std::uint16_t> image = std::vector<std::uint16_t>(640 * 488);
};

Fake fake;

freenect_device* device() { return reinterpret_cast<freenect_device*>(&fake); }

freenect_frame_mode mode(int format) {
  freenect_frame_mode m{};
  m.resolution = FREENECT_RESOLUTION_MEDIUM;
  m.dummy = format;
  m.width = 640;
  m.height = 480;
  m.framerate = 30;
  m.is_valid = 1;
  return m;
}

void* filled(int value) {
  std::fill(fake.image.begin(), fake.image.end(), static_cast<std::uint16_t>(value));
  return fake.image.data();
}

}  // namespace

extern "C" {

int freenect_init(freenect_context** context, freenect_usb_context*) {
  *context = reinterpret_cast<freenect_context*>(&fake);
  return 0;
}
int freenect_shutdown(freenect_context*) { return 0; }
void freenect_set_log_level(freenect_context*, freenect_loglevel) {}
void freenect_set_log_callback(freenect_context*, freenect_log_cb) {}
void freenect_select_subdevices(freenect_context*, freenect_device_flags) {}
int freenect_num_devices(freenect_context*) { return Clock::now() >= fake.back ? 1 : 0; }
int freenect_open_device(freenect_context*, freenect_device** opened, int index) {
  if (index != 0 || Clock::now() < fake.back) return -1;
  *opened = device();
  return 0;
}
int freenect_close_device(freenect_device*) { return 0; }
void freenect_set_user(freenect_device*, void* user) { fake.user = user; }
void* freenect_get_user(freenect_device*) { return fake.user; }
void freenect_set_depth_callback(freenect_device*, freenect_depth_cb callback) { fake.on_depth = callback; }
void freenect_set_video_callback(freenect_device*, freenect_video_cb callback) { fake.on_video = callback; }
int freenect_get_depth_mode_count() { return 3; }
freenect_frame_mode freenect_get_depth_mode(int number) {
  constexpr freenect_depth_format kFormats[] = {FREENECT_DEPTH_11BIT, FREENECT_DEPTH_REGISTERED,
                                                FREENECT_DEPTH_MM};
  return mode(kFormats[number]);
}
int freenect_set_depth_mode(freenect_device*, freenect_frame_mode m) {
  fake.depth_format = m.depth_format;
  return 0;
}
freenect_frame_mode freenect_find_video_mode(freenect_resolution, freenect_video_format format) {
  return mode(format);
}
int freenect_set_video_mode(freenect_device*, freenect_frame_mode m) {
  return m.video_format == FREENECT_VIDEO_IR_10BIT ? 0 : -1;
}
int freenect_start_depth(freenect_device*) { return fake.depth_runs = true, 0; }
int freenect_start_video(freenect_device*) { return fake.video_runs = true, 0; }
int freenect_stop_depth(freenect_device*) { return fake.depth_runs = false, 0; }
int freenect_stop_video(freenect_device*) { return fake.video_runs = false, 0; }
int freenect_set_flag(freenect_device*, freenect_flag, freenect_flag_value) { return 0; }

freenect_registration freenect_copy_registration(freenect_device*) {
  freenect_registration registration{};
  registration.zero_plane_info = {7.5F, 2.3F, 120, 0.1042F};
  registration.const_shift = 200;
  return registration;
}
int freenect_destroy_registration(freenect_registration*) { return 0; }

int freenect_process_events_timeout(freenect_context*, timeval*) {
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  const char* loss = std::getenv("FAKE_KINECT_FRAMES");
  if (loss != nullptr && !fake.was_lost && fake.frames >= std::atoi(loss)) {
    fake.was_lost = true;
    fake.back = Clock::now() + std::chrono::milliseconds(1500);
    return -1;
  }
  ++fake.frames;
  const std::uint32_t ticks = fake.frames * 2'000'000U;
  if (fake.depth_runs)
    fake.on_depth(device(),
                  filled((fake.depth_format == FREENECT_DEPTH_REGISTERED ? 1000 : 2000) + fake.frames),
                  ticks);
  if (fake.video_runs) fake.on_video(device(), filled(300 + fake.frames), ticks);
  return 0;
}

}  // extern "C"
