/* A PI controller in a shared library: cc -O2 -shared -fPIC -I../../controllers -o plugin.so plugin.c
 * mckibben_controller.h says what each function is for. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <mckibben_controller.h>

typedef struct {
  mckibben_controller_hello known;
  double gain_mA, integral_time_s, integral_mA;
} pi_controller;

int mckibben_controller_version(void) {
  return MCKIBBEN_CONTROLLER_VERSION;
}

void* mckibben_controller_open(const mckibben_controller_hello* hello, char* why) {
  pi_controller start = {*hello, 30.0, 0.3, hello->lowest_mA};
  if (*hello->settings != '\0' &&
      sscanf(hello->settings, "gain=%lf Ti=%lf", &start.gain_mA, &start.integral_time_s) != 2) {
    snprintf(why, MCKIBBEN_CONTROLLER_WHY, "settings are gain=MA Ti=S, not: %s", hello->settings);
    return NULL;
  }
  pi_controller* self = malloc(sizeof *self);
  if (self != NULL) *self = start;
  return self;
}

double mckibben_controller_rest(void* self) {
  return ((pi_controller*)self)->known.lowest_mA;
}

int mckibben_controller_step(void* self, const mckibben_controller_reading* reading, double* current_mA, char* why) {
  pi_controller* pi = self;
  const double ratio = ((double)reading->counts + pi->known.middle_of_count) * pi->known.contraction_per_count;
  const double error = reading->target - ratio;
  const double wanted_mA = pi->integral_mA + pi->gain_mA * error;
  (void)why; /* nothing can go wrong */
  *current_mA = fmin(fmax(wanted_mA, pi->known.lowest_mA), pi->known.highest_mA);
  if (*current_mA == wanted_mA) /* at a limit the integral waits */
    pi->integral_mA = pi->integral_mA + pi->gain_mA * pi->known.period_s / pi->integral_time_s * error;
  return 0;
}

void mckibben_controller_close(void* self) {
  free(self);
}
