/* A controller of yours in a shared library: five functions in C (docs/your_controller.md).
 *
 * Each run has a controller of its own. Runs go on in several threads at once, so keep what a controller
 * remembers in what `open` gives, and in no global variable. */
#ifndef MCKIBBEN_CONTROLLER_H
#define MCKIBBEN_CONTROLLER_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define MCKIBBEN_CONTROLLER_VERSION 2 /* 1 had no command_unit; it still drives valves that take mA */
#define MCKIBBEN_CONTROLLER_WHY 256 /* bytes of a message, its end with it */

/* What is known on paper before the run. Pointers are valid until `close`. What is called mA is in
 * `command_unit`: a valve may take volts or a pressure as well. */
typedef struct {
  double period_s;                        /* from tick to tick */
  double contraction_per_count;           /* contraction ratio of one count */
  double middle_of_count;                 /* counts by which a position is more than its reading, on average */
  double rest_length_m;                   /* of the muscle: contraction ratio x rest length = rise of the load */
  double lowest_mA, highest_mA;           /* between which it is obeyed */
  double largest_current_speed_mA_per_s;  /* infinite if there is no such limit */
  double load_kg;                         /* not a number unless the scenario says tell_load: true */
  int64_t preparation_ticks;              /* the first tick is minus this */
  const double* target;                   /* contraction ratio at tick 0, 1, ... */
  size_t target_ticks;
  const char* settings;                   /* what the scenario says behind `settings`, else "" */
  const char* command_unit;               /* "mA", "V" or "bar" */
} mckibben_controller_hello;

/* What the hardware shows at a tick. */
typedef struct {
  int64_t tick;
  double time_s;
  int64_t counts;
  int counts_lost; /* not 0: the counter jumps, and these are the counts of an earlier tick */
  double target;   /* contraction ratio that is wanted now */
} mckibben_controller_reading;

/* MCKIBBEN_CONTROLLER_VERSION of this header. */
int mckibben_controller_version(void);

/* A controller at its beginning; NULL if it cannot do its work, the reason in `why`. */
void* mckibben_controller_open(const mckibben_controller_hello* hello, char* why);

/* Command held while the rig settles, before the first tick. */
double mckibben_controller_rest(void* self);

/* Command from this tick to the next. Not 0 ends the run as failed, the reason in `why`. */
int mckibben_controller_step(void* self, const mckibben_controller_reading* reading, double* current_mA, char* why);

/* The run is over. */
void mckibben_controller_close(void* self);

#ifdef __cplusplus
}
#endif

#endif
