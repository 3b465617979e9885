// Something like a driver module of another maker, which lacks parts of itself: the function of a library of
// its own (ACME_NEEDS_MORE), or of OpenNI2's interface.
extern "C" {
#ifdef ACME_NEEDS_MORE
void acme_start();
void oniDriverCreate(void*) { acme_start(); }
#else
void oniDriverCreate(void*) {}
#endif
}
