// Part of every program that uses sensors or OpenGL, in builds with AddressSanitizer. OpenNI2 and GLFW unload
// drivers at the end, whose memory LeakSanitizer would report as lost. Therefore nothing is unloaded.
extern "C" int dlclose(void*) noexcept { return 0; }
