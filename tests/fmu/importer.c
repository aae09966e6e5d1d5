/* An importer of FMUs for co-simulation that knows nothing but the functions of the standard, in versions 2.0
 * and 3.0. It does what it reads, line by line, with up to four instances:
 *   importer LIBRARY 2|3 TOKEN RESOURCES
 *   I set REFERENCE VALUE | I get REFERENCE | I count REFERENCE | I init TIME | I start | I step TIME LENGTH
 *   I save | I restore | I reset | I end | I write FILE | I read FILE
 * `save` keeps a state, `write` writes the kept one as bytes, `read` reads bytes as the kept one. I: the number of an instance. Of what was asked for it prints a line; what fails is `failed`, with the log. */
#include <dlfcn.h>
#include <locale.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
  void (*logger)(void*, const char*, int, const char*, const char*, ...);
  void* (*allocate)(size_t, size_t);
  void (*release)(void*);
  void (*step_finished)(void*, int);
  void* environment;
} callbacks2;

static void tell2(void* environment, const char* instance, int status, const char* category, const char* message, ...) {
  __builtin_va_list rest;
  (void)environment, (void)instance, (void)status, (void)category;
  __builtin_va_start(rest, message);
  vprintf(message, rest);
  __builtin_va_end(rest);
  printf("\n");
}
static void tell3(void* environment, int status, const char* category, const char* message) {
  (void)environment, (void)status, (void)category;
  printf("%s\n", message);
}

static void* library;
static int version;
static locale_t plain; /* of what is read and printed here; an FMU sees the user's */

typedef void (*any_function)(void);

static any_function function(const char* name) {
  char full[64];
  any_function known;
  snprintf(full, sizeof full, "fmi%d%s", version, name);
  void* found = dlsym(library, full);
  if (found == NULL) {
    fprintf(stderr, "no %s\n", full);
    exit(2);
  }
  memcpy(&known, &found, sizeof known);
  uselocale(LC_GLOBAL_LOCALE);
  return known;
}
#define CALL(name, ...) ((int (*)(__VA_ARGS__))function(name))

static void* made(const char* token, const char* resources) {
  static const callbacks2 callbacks = {tell2, calloc, free, NULL, NULL};
  if (version == 2) {
    typedef void* (*maker2)(const char*, int, const char*, const char*, const callbacks2*, int, int);
    return ((maker2)function("Instantiate"))("one", 1, token, resources, &callbacks, 0, 1);
  }
  typedef void* (*maker3)(const char*, const char*, const char*, bool, bool, bool, bool, const uint32_t*, size_t, void*,
                          void (*)(void*, int, const char*, const char*), void*);
  return ((maker3)function("InstantiateCoSimulation"))("one", token, resources, false, true, false, false, NULL, 0, NULL, tell3, NULL);
}

static int initialise(void* it, double at) {
  if (version == 3)
    return CALL("EnterInitializationMode", void*, bool, double, double, bool, double)(it, false, 0.0, at, false, 0.0);
  int status = CALL("SetupExperiment", void*, int, double, double, int, double)(it, 0, 0.0, at, 0, 0.0);
  return status ? status : CALL("EnterInitializationMode", void*)(it);
}

static int step(void* it, double at, double length) {
  if (version == 2) return CALL("DoStep", void*, double, double, int)(it, at, length, 1);
  bool event, end, early;
  double reached;
  int status = CALL("DoStep", void*, double, double, bool, bool*, bool*, bool*, double*)(it, at, length, true, &event,
                                                                                           &end, &early, &reached);
  return status || event || end || early || reached != at + length;
}

static int set(void* it, uint32_t reference, double value) {
  if (version == 2)
    return CALL("SetReal", void*, const uint32_t*, size_t, const double*)(it, &reference, 1, &value);
  return CALL("SetFloat64", void*, const uint32_t*, size_t, const double*, size_t)(it, &reference, 1, &value, 1);
}

static int get(void* it, uint32_t reference, double* value) {
  if (version == 2) return CALL("GetReal", void*, const uint32_t*, size_t, double*)(it, &reference, 1, value);
  return CALL("GetFloat64", void*, const uint32_t*, size_t, double*, size_t)(it, &reference, 1, value, 1);
}

static int count(void* it, uint32_t reference, double* value) {
  int whole = 0;
  int64_t long_whole = 0;
  int status = version == 2 ? CALL("GetInteger", void*, const uint32_t*, size_t, int*)(it, &reference, 1, &whole)
                            : CALL("GetInt64", void*, const uint32_t*, size_t, int64_t*, size_t)(it, &reference, 1,
                                                                                                 &long_whole, 1);
  *value = version == 2 ? (double)whole : (double)long_whole;
  return status;
}

static void show(double value) {
  uselocale(plain);
  printf("%.17g\n", value);
}

/* The kept state into a file; what is there as a state. */
static int write_state(void* it, void* state, const char* path) {
  size_t size = 0;
  if (CALL(version == 2 ? "SerializedFMUstateSize" : "SerializedFMUStateSize", void*, void*, size_t*)(it, state, &size))
    return 1;
  char* const bytes = malloc(size);
  FILE* const file = fopen(path, "wb");
  int status = bytes == NULL || file == NULL ||
               CALL(version == 2 ? "SerializeFMUstate" : "SerializeFMUState", void*, void*, char*, size_t)(it, state, bytes, size);
  if (!status) status = fwrite(bytes, 1, size, file) != size;
  if (file != NULL) fclose(file);
  free(bytes);
  return status;
}
static int read_state(void* it, void** state, const char* path) {
  static char bytes[1 << 16];
  FILE* const file = fopen(path, "rb");
  if (file == NULL) return 1;
  const size_t size = fread(bytes, 1, sizeof bytes, file);
  fclose(file);
  return CALL(version == 2 ? "DeSerializeFMUstate" : "DeserializeFMUState", void*, const char*, size_t, void**)(it, bytes, size, state);
}

int main(int argc, char** argv) {
  void* instances[4] = {NULL};
  void* states[4] = {NULL};
  char verb[16], file[64];
  unsigned which;
  if (argc != 5 || (library = dlopen(argv[1], RTLD_NOW | RTLD_LOCAL)) == NULL) {
    fprintf(stderr, "%s\n", argc != 5 ? "four arguments" : dlerror());
    return 2;
  }
  version = atoi(argv[2]);
  setlocale(LC_ALL, ""); /* as programs with windows do */
  plain = newlocale(LC_ALL_MASK, "C", NULL);
  uselocale(plain);
  const char* get_state = version == 2 ? "GetFMUstate" : "GetFMUState";
  const char* set_state = version == 2 ? "SetFMUstate" : "SetFMUState";
  while (scanf("%u %15s", &which, verb) == 2 && which < 4) {
    double a = 0.0, b = 0.0;
    unsigned reference = 0;
    int failed = 0;
    if (instances[which] == NULL) instances[which] = made(argv[3], argv[4]);
    uselocale(plain);
    void* it = instances[which];
    if (it == NULL) {
      printf("failed\n");
      break;
    }
    if (strcmp(verb, "set") == 0 && scanf("%u %lf", &reference, &a) == 2)
      failed = set(it, reference, a);
    else if (strcmp(verb, "get") == 0 && scanf("%u", &reference) == 1 && !(failed = get(it, reference, &a)))
      show(a);
    else if (strcmp(verb, "count") == 0 && scanf("%u", &reference) == 1 && !(failed = count(it, reference, &a)))
      show(a);
    else if (strcmp(verb, "init") == 0 && scanf("%lf", &a) == 1)
      failed = initialise(it, a);
    else if (strcmp(verb, "start") == 0)
      failed = CALL("ExitInitializationMode", void*)(it);
    else if (strcmp(verb, "step") == 0 && scanf("%lf %lf", &a, &b) == 2)
      failed = step(it, a, b);
    else if (strcmp(verb, "save") == 0)
      failed = CALL(get_state, void*, void**)(it, &states[which]);
    else if (strcmp(verb, "restore") == 0)
      failed = CALL(set_state, void*, void*)(it, states[which]);
    else if (strcmp(verb, "write") == 0 && scanf("%63s", file) == 1)
      failed = write_state(it, states[which], file);
    else if (strcmp(verb, "read") == 0 && scanf("%63s", file) == 1)
      failed = read_state(it, &states[which], file);
    else if (strcmp(verb, "end") == 0)
      failed = CALL("Terminate", void*)(it);
    else if (strcmp(verb, "reset") == 0)
      failed = CALL("Reset", void*)(it);
    if (failed) printf("failed\n");
    uselocale(plain);
  }
  for (int i = 0; i < 4; ++i) {
    if (states[i] != NULL) CALL(version == 2 ? "FreeFMUstate" : "FreeFMUState", void*, void**)(instances[i], &states[i]);
    if (instances[i] != NULL) ((void (*)(void*))function("FreeInstance"))(instances[i]);
  }
  return 0;
}
