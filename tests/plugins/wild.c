/* A controller in a library that does as it was told, and at tick 10 what its settings say
 * (tests/bench/hosted_test.cpp). */
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <mckibben_controller.h>

static const char* mode;

static int is(const char* wanted) {
  return strcmp(mode, wanted) == 0;
}

int mckibben_controller_version(void) {
  return MCKIBBEN_CONTROLLER_VERSION;
}

void* mckibben_controller_open(const mckibben_controller_hello* hello, char* why) {
  mode = strdup(hello->settings);
  if (is("refuses")) memset(why, 0xff, MCKIBBEN_CONTROLLER_WHY);
  while (is("never_begins")) pause();
  return is("refuses") ? NULL : (void*)mode;
}

double mckibben_controller_rest(void* self) {
  (void)self;
  return is("rests_at_nan") ? NAN : 6.0;
}

int mckibben_controller_step(void* self, const mckibben_controller_reading* reading, double* current_mA, char* why) {
  (void)self;
  *current_mA = 7.0;
  if (reading->tick != 10) return 0;
  if (is("nan")) *current_mA = NAN;
  if (is("infinite")) *current_mA = INFINITY;
  if (is("no_text")) memset(why, 0xfe, MCKIBBEN_CONTROLLER_WHY);
  if (is("half_a_letter"))
    for (size_t i = 0; i + 1 < MCKIBBEN_CONTROLLER_WHY; ++i) why[i] = i % 2 == 0 ? '\xc3' : '\xa4';
  if (is("exits")) exit(0);
  if (is("exits_at_once")) _exit(0);
  if (is("crashes")) raise(SIGSEGV);
  if (is("aborts")) abort();
  if (is("is_killed")) raise(SIGKILL);
  if (is("suspends")) raise(SIGSTOP);
  if (is("ends_us")) kill(getppid(), SIGTERM);
  while (is("hangs")) pause();
  if (is("closes_all"))
    for (int i = 0; i < 1000; ++i) close(i);
  if (is("prints")) printf("hello\n");
  return is("no_text") || is("half_a_letter");
}

void mckibben_controller_close(void* self) {
  if (is("crashes_at_the_end")) raise(SIGSEGV);
  free(self);
}
