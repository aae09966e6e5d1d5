/* A PI controller in a process of its own, without any library: cc -O2 -o controller controller.c
 * docs/your_controller.md says which lines go to and fro. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double gain_mA = 30.0, integral_time_s = 0.3;

/* The number behind "key": in a line. Good enough for these lines, which hold no text. */
static double number(const char* line, const char* key) {
  char quoted[64];
  snprintf(quoted, sizeof quoted, "\"%s\":", key);
  const char* found = strstr(line, quoted);
  if (found == NULL) {
    fprintf(stderr, "there is no %s in: %s", key, line);
    exit(1);
  }
  return strtod(found + strlen(quoted), NULL);
}

static void answer(double current_mA) {
  printf("%.17g\n", current_mA);
  fflush(stdout);
}

int main(void) {
  char* line = NULL;
  size_t room = 0;
  if (getline(&line, &room, stdin) < 0 || number(line, "mckibben_controller") != 1.0) return 1;
  const double low_mA = number(line, "lowest_mA"), high_mA = number(line, "highest_mA");
  const double period_s = number(line, "period_s"), middle = number(line, "middle_of_count");
  const double contraction_per_count = number(line, "contraction_per_count");
  double integral_mA = low_mA;
  answer(low_mA); /* while the rig settles */

  while (getline(&line, &room, stdin) >= 0) {
    const double ratio = (number(line, "counts") + middle) * contraction_per_count;
    const double error = number(line, "target") - ratio;
    const double wanted_mA = integral_mA + gain_mA * error;
    const double current_mA = fmin(fmax(wanted_mA, low_mA), high_mA);
    if (current_mA == wanted_mA) /* at a limit the integral waits */
      integral_mA = integral_mA + gain_mA * period_s / integral_time_s * error;
    answer(current_mA);
  }
  free(line);
  return 0;
}
