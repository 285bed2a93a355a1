/* FMI 2.0 for co-simulation: the functions of the standard (Modelica Association, 2014, version 2.0, chapter 2 and 4), over one
 * instance. Types are those of the standard; what belongs to model exchange is no part of an FMU for co-simulation. */
#include "instance.h"
#include <ctype.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef enum { fmi2OK, fmi2Warning, fmi2Discard, fmi2Error, fmi2Fatal, fmi2Pending } fmi2Status;
typedef void (*logger2)(void *environment, const char *name, fmi2Status status, const char *category, const char *message, ...);

/* What an importer hands over; its pointer is valid as long as the instance */
typedef struct {
   logger2 logger;
   void *(*allocate)(size_t count, size_t size);
   void (*release)(void *memory);
   void (*step_finished)(void *environment, fmi2Status status);
   void *environment;
} callbacks2;

typedef struct {
   instance *core;
   const callbacks2 *callbacks;
   char *name;
   double start_time;
} component;

/* A message is a format, where % and # begin something: each stands twice for itself. */
static void tell(void *who, int is_error, const char *message) {
   component *self = who;
   char text[2 * sizeof ((camroller_error *)0)->message], *next = text;
   if (self->callbacks->logger == NULL) return;
   for (; *message != 0 && next < text + sizeof text - 2; message++) {
      *next++ = *message;
      if (*message == '%' || *message == '#') *next++ = *message;
   }
   *next = 0;
   self->callbacks->logger(self->callbacks->environment, self->name, is_error ? fmi2Error : fmi2Warning,
                           is_error ? "logStatusError" : "logStatusWarning", text);
}

static fmi2Status status_of(int is_right) {
   return is_right ? fmi2OK : fmi2Error;
}

const char *fmi2GetTypesPlatform(void) {
   return "default";
}

const char *fmi2GetVersion(void) {
   return "2.0";
}

fmi2Status fmi2SetDebugLogging(void *c, int is_on, size_t count, const char *const categories[]) {
   (void)c, (void)is_on, (void)count, (void)categories;
   return fmi2OK;
}

/* Path of a URI of a file; other characters than letters are written as % and two hexadecimal digits there */
static void path_of(const char *uri, char *path, size_t room) {
   if (strncmp(uri, "file://", 7) == 0) {
      uri += 7;
      if (*uri != '/' && strchr(uri, '/') != NULL) uri = strchr(uri, '/');
   } else if (strncmp(uri, "file:", 5) == 0) {
      uri += 5;
   }
   while (*uri != 0 && room > 1) {
      if (*uri == '%' && isxdigit((unsigned char)uri[1]) && isxdigit((unsigned char)uri[2])) {
         const char digits[] = {uri[1], uri[2], 0};
         *path++ = (char)strtol(digits, NULL, 16);
         uri += 3;
      } else {
         *path++ = *uri++;
      }
      room--;
   }
   *path = 0;
}

void fmi2FreeInstance(void *c) {
   component *self = c;
   if (self == NULL) return;
   instance_free(self->core);
   free(self->name);
   free(self);
}

void *fmi2Instantiate(const char *name, int type, const char *guid, const char *resources, const callbacks2 *callbacks, int visible,
                      int logging) {
   char path[4096];
   component *self = calloc(1, sizeof *self);
   (void)visible, (void)logging;
   if (self == NULL) return NULL;
   self->callbacks = callbacks;
   self->name = calloc(1, strlen(name) + 1);
   if (self->name != NULL) strcpy(self->name, name);
   if (self->name == NULL || type != 1 || resources == NULL) {
      tell(self, 1, "the FMU is for co-simulation, and needs the place of its resources");
   } else {
      path_of(resources, path, sizeof path);
      self->core = instance_new(path, guid, tell, self);
   }
   if (self->core != NULL) return self;
   fmi2FreeInstance(self);
   return NULL;
}

fmi2Status fmi2SetupExperiment(void *c, int has_tolerance, double tolerance, double start, int has_stop, double stop) {
   (void)has_tolerance, (void)tolerance, (void)has_stop, (void)stop;
   ((component *)c)->start_time = start;
   return fmi2OK;
}

fmi2Status fmi2EnterInitializationMode(void *c) {
   (void)c;
   return fmi2OK;
}

fmi2Status fmi2ExitInitializationMode(void *c) {
   component *self = c;
   return status_of(instance_start(self->core, self->start_time));
}

fmi2Status fmi2Terminate(void *c) {
   (void)c;
   return fmi2OK;
}

fmi2Status fmi2Reset(void *c) {
   return status_of(instance_reset(((component *)c)->core));
}

fmi2Status fmi2GetReal(void *c, const unsigned numbers[], size_t count, double values[]) {
   for (size_t i = 0; i < count; i++)
      if (!instance_get(((component *)c)->core, numbers[i], &values[i])) return fmi2Error;
   return fmi2OK;
}

fmi2Status fmi2SetReal(void *c, const unsigned numbers[], size_t count, const double values[]) {
   for (size_t i = 0; i < count; i++)
      if (!instance_set(((component *)c)->core, numbers[i], values[i])) return fmi2Error;
   return fmi2OK;
}

fmi2Status fmi2GetBoolean(void *c, const unsigned numbers[], size_t count, int values[]) {
   double value;
   for (size_t i = 0; i < count; i++) {
      if (!instance_get(((component *)c)->core, numbers[i], &value)) return fmi2Error;
      values[i] = value != 0.0;
   }
   return fmi2OK;
}

fmi2Status fmi2SetBoolean(void *c, const unsigned numbers[], size_t count, const int values[]) {
   for (size_t i = 0; i < count; i++)
      if (!instance_set(((component *)c)->core, numbers[i], values[i] != 0)) return fmi2Error;
   return fmi2OK;
}

/* The FMU has no variables of these types */
static fmi2Status none_of(void *c, size_t count) {
   return count == 0 ? fmi2OK : status_of(instance_refuse(((component *)c)->core, "the FMU has no variables of this type"));
}

fmi2Status fmi2GetInteger(void *c, const unsigned numbers[], size_t count, int values[]) {
   (void)numbers, (void)values;
   return none_of(c, count);
}

fmi2Status fmi2SetInteger(void *c, const unsigned numbers[], size_t count, const int values[]) {
   (void)numbers, (void)values;
   return none_of(c, count);
}

fmi2Status fmi2GetString(void *c, const unsigned numbers[], size_t count, const char *values[]) {
   (void)numbers, (void)values;
   return none_of(c, count);
}

fmi2Status fmi2SetString(void *c, const unsigned numbers[], size_t count, const char *const values[]) {
   (void)numbers, (void)values;
   return none_of(c, count);
}

fmi2Status fmi2GetFMUstate(void *c, void **place) {
   return status_of(state_take(((component *)c)->core, (state **)place));
}

fmi2Status fmi2SetFMUstate(void *c, void *kept) {
   return status_of(state_put_back(((component *)c)->core, kept));
}

fmi2Status fmi2FreeFMUstate(void *c, void **place) {
   (void)c;
   state_free(*place);
   *place = NULL;
   return fmi2OK;
}

fmi2Status fmi2SerializedFMUstateSize(void *c, void *kept, size_t *size) {
   *size = state_size(((component *)c)->core, kept);
   return fmi2OK;
}

fmi2Status fmi2SerializeFMUstate(void *c, void *kept, char bytes[], size_t size) {
   return status_of(state_to_bytes(((component *)c)->core, kept, bytes, size));
}

fmi2Status fmi2DeSerializeFMUstate(void *c, const char bytes[], size_t size, void **place) {
   return status_of(state_from_bytes(((component *)c)->core, bytes, size, (state **)place));
}

/* What the model description says that the FMU does not do */
static fmi2Status not_done(void *c) {
   return status_of(instance_refuse(((component *)c)->core, "the FMU does not do this, as its model description says"));
}

fmi2Status fmi2GetDirectionalDerivative(void *c, const unsigned unknown[], size_t unknowns, const unsigned known[], size_t knowns,
                                        const double seed[], double derivative[]) {
   (void)unknown, (void)unknowns, (void)known, (void)knowns, (void)seed, (void)derivative;
   return not_done(c);
}

fmi2Status fmi2SetRealInputDerivatives(void *c, const unsigned numbers[], size_t count, const int orders[], const double values[]) {
   (void)numbers, (void)count, (void)orders, (void)values;
   return not_done(c);
}

fmi2Status fmi2GetRealOutputDerivatives(void *c, const unsigned numbers[], size_t count, const int orders[], double values[]) {
   (void)numbers, (void)count, (void)orders, (void)values;
   return not_done(c);
}

fmi2Status fmi2DoStep(void *c, double time, double length, int no_way_back) {
   (void)no_way_back;
   return status_of(instance_step(((component *)c)->core, time, length));
}

fmi2Status fmi2CancelStep(void *c) {
   return not_done(c);
}

fmi2Status fmi2GetStatus(void *c, int kind, fmi2Status *value) {
   (void)kind, (void)value;
   not_done(c);
   return fmi2Discard;
}

fmi2Status fmi2GetRealStatus(void *c, int kind, double *value) {
   (void)kind, (void)value;
   not_done(c);
   return fmi2Discard;
}

fmi2Status fmi2GetIntegerStatus(void *c, int kind, int *value) {
   (void)kind, (void)value;
   not_done(c);
   return fmi2Discard;
}

fmi2Status fmi2GetBooleanStatus(void *c, int kind, int *value) {
   (void)kind, (void)value;
   not_done(c);
   return fmi2Discard;
}

fmi2Status fmi2GetStringStatus(void *c, int kind, const char **value) {
   (void)kind, (void)value;
   not_done(c);
   return fmi2Discard;
}
