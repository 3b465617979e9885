// Part of every program that uses sensors or OpenGL, in a build with AddressSanitizer. OpenNI2 and GLFW
// unload drivers at their end; LeakSanitizer would take what those hold for lost. So nothing is unloaded.
extern "C" int dlclose(void*) noexcept { return 0; }
