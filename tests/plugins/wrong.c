/* Controllers in a library that are wrong in one way each (tests/controllers/guest_test.cpp): LATER and EARLIER
 * are of another version, POOR lacks functions, SILENT gives no current. */
#include <math.h>

#include <mckibben_controller.h>

int mckibben_controller_version(void) {
#ifdef LATER
  return 3;
#elif defined EARLIER
  return 1;
#else
  return MCKIBBEN_CONTROLLER_VERSION;
#endif
}

void* mckibben_controller_open(const mckibben_controller_hello* hello, char* why) {
  static int self;
  (void)hello;
  (void)why;
  return &self;
}

#ifndef POOR
double mckibben_controller_rest(void* self) {
  (void)self;
  return 4.0;
}

int mckibben_controller_step(void* self, const mckibben_controller_reading* reading, double* current_mA, char* why) {
  (void)self;
  (void)reading;
  (void)current_mA;
  (void)why;
  return 0;
}

void mckibben_controller_close(void* self) {
  (void)self;
}
#endif
