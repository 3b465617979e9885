// Part of every program that uses sensors, in a build with AddressSanitizer. OpenNI2 unloads its driver modules
// at its end; LeakSanitizer would take what they hold for lost. So nothing is unloaded.
extern "C" int dlclose(void*) noexcept { return 0; }
