/* FMI 3.0 for co-simulation: the functions of the standard (Modelica Association, 2022, version 3.0, chapter 2 and 4), over one
 * instance. Types are those of the standard. A library has to have all functions; those that belong to other kinds of FMUs, or to
 * types of variables that this one has not, return the error that the standard asks for. */
#include "instance.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>

typedef enum { fmi3OK, fmi3Warning, fmi3Discard, fmi3Error, fmi3Fatal } fmi3Status;
typedef void (*logger3)(void *environment, fmi3Status status, const char *category, const char *message);

typedef struct {
   instance *core;
   logger3 logger;
   void *environment;
   double start_time;
} component;

static void tell(void *who, int is_error, const char *message) {
   component *self = who;
   if (self->logger == NULL) return;
   self->logger(self->environment, is_error ? fmi3Error : fmi3Warning, is_error ? "logStatusError" : "logStatusWarning", message);
}

static fmi3Status status_of(int is_right) {
   return is_right ? fmi3OK : fmi3Error;
}

const char *fmi3GetVersion(void) {
   return "3.0";
}

fmi3Status fmi3SetDebugLogging(void *c, bool is_on, size_t count, const char *const categories[]) {
   (void)c, (void)is_on, (void)count, (void)categories;
   return fmi3OK;
}

void fmi3FreeInstance(void *c) {
   component *self = c;
   if (self == NULL) return;
   instance_free(self->core);
   free(self);
}

void *fmi3InstantiateCoSimulation(const char *name, const char *token, const char *resources, bool visible, bool logging,
                                  bool event_mode, bool early_return, const uint32_t intermediate[], size_t intermediates,
                                  void *environment, logger3 logger, void (*update)(void)) {
   component *self = calloc(1, sizeof *self);
   (void)name, (void)visible, (void)logging, (void)event_mode, (void)early_return, (void)intermediate;
   (void)intermediates, (void)update;
   if (self == NULL) return NULL;
   self->logger = logger;
   self->environment = environment;
   if (resources == NULL) {
      tell(self, 1, "the FMU needs the place of its resources");
   } else {
      self->core = instance_new(resources, token, tell, self);
   }
   if (self->core != NULL) return self;
   fmi3FreeInstance(self);
   return NULL;
}

void *fmi3InstantiateModelExchange(const char *name, const char *token, const char *resources, bool visible, bool logging,
                                   void *environment, logger3 logger) {
   (void)name, (void)token, (void)resources, (void)visible, (void)logging;
   if (logger != NULL) logger(environment, fmi3Error, "logStatusError", "the FMU is for co-simulation");
   return NULL;
}

void *fmi3InstantiateScheduledExecution(const char *name, const char *token, const char *resources, bool visible, bool logging,
                                        void *environment, logger3 logger, void (*update)(void), void (*lock)(void),
                                        void (*unlock)(void)) {
   (void)update, (void)lock, (void)unlock;
   return fmi3InstantiateModelExchange(name, token, resources, visible, logging, environment, logger);
}

fmi3Status fmi3EnterInitializationMode(void *c, bool has_tolerance, double tolerance, double start, bool has_stop, double stop) {
   (void)has_tolerance, (void)tolerance, (void)has_stop, (void)stop;
   ((component *)c)->start_time = start;
   return fmi3OK;
}

fmi3Status fmi3ExitInitializationMode(void *c) {
   component *self = c;
   return status_of(instance_start(self->core, self->start_time));
}

fmi3Status fmi3Terminate(void *c) {
   (void)c;
   return fmi3OK;
}

fmi3Status fmi3Reset(void *c) {
   return status_of(instance_reset(((component *)c)->core));
}

/* Every variable is one number */
static fmi3Status check_scalars(void *c, size_t count, size_t values) {
   return count == values ? fmi3OK : status_of(instance_refuse(((component *)c)->core, "the FMU has no arrays"));
}

fmi3Status fmi3GetFloat64(void *c, const uint32_t numbers[], size_t count, double values[], size_t value_count) {
   if (check_scalars(c, count, value_count) != fmi3OK) return fmi3Error;
   for (size_t i = 0; i < count; i++)
      if (!instance_get(((component *)c)->core, numbers[i], &values[i])) return fmi3Error;
   return fmi3OK;
}

fmi3Status fmi3SetFloat64(void *c, const uint32_t numbers[], size_t count, const double values[], size_t value_count) {
   if (check_scalars(c, count, value_count) != fmi3OK) return fmi3Error;
   for (size_t i = 0; i < count; i++)
      if (!instance_set(((component *)c)->core, numbers[i], values[i])) return fmi3Error;
   return fmi3OK;
}

fmi3Status fmi3GetBoolean(void *c, const uint32_t numbers[], size_t count, bool values[], size_t value_count) {
   double value;
   if (check_scalars(c, count, value_count) != fmi3OK) return fmi3Error;
   for (size_t i = 0; i < count; i++) {
      if (!instance_get(((component *)c)->core, numbers[i], &value)) return fmi3Error;
      values[i] = value != 0.0;
   }
   return fmi3OK;
}

fmi3Status fmi3SetBoolean(void *c, const uint32_t numbers[], size_t count, const bool values[], size_t value_count) {
   if (check_scalars(c, count, value_count) != fmi3OK) return fmi3Error;
   for (size_t i = 0; i < count; i++)
      if (!instance_set(((component *)c)->core, numbers[i], values[i])) return fmi3Error;
   return fmi3OK;
}

fmi3Status fmi3GetFMUState(void *c, void **place) {
   return status_of(state_take(((component *)c)->core, (state **)place));
}

fmi3Status fmi3SetFMUState(void *c, void *kept) {
   return status_of(state_put_back(((component *)c)->core, kept));
}

fmi3Status fmi3FreeFMUState(void *c, void **place) {
   (void)c;
   state_free(*place);
   *place = NULL;
   return fmi3OK;
}

fmi3Status fmi3SerializedFMUStateSize(void *c, void *kept, size_t *size) {
   *size = state_size(((component *)c)->core, kept);
   return fmi3OK;
}

fmi3Status fmi3SerializeFMUState(void *c, void *kept, uint8_t bytes[], size_t size) {
   return status_of(state_to_bytes(((component *)c)->core, kept, (char *)bytes, size));
}

fmi3Status fmi3DeserializeFMUState(void *c, const uint8_t bytes[], size_t size, void **place) {
   return status_of(state_from_bytes(((component *)c)->core, (const char *)bytes, size, (state **)place));
}

fmi3Status fmi3EnterStepMode(void *c) {
   (void)c;
   return fmi3OK;
}

fmi3Status fmi3DoStep(void *c, double time, double length, bool no_way_back, bool *needs_event, bool *ends, bool *returns_early,
                      double *last_time) {
   (void)no_way_back;
   *needs_event = *ends = *returns_early = false;
   *last_time = time;
   if (!instance_step(((component *)c)->core, time, length)) return fmi3Error;
   *last_time = time + length;
   return fmi3OK;
}

/* Functions of what the model description says that the FMU does not have or do. Their arguments are not read: the calling
 * convention of C lets the caller hand over more than a function takes. */
static fmi3Status not_done(void *c) {
   return status_of(instance_refuse(((component *)c)->core, "the FMU does not do this, as its model description says"));
}

#define NOT_DONE(name) \
   fmi3Status fmi3##name(void *c) { \
      return not_done(c); \
   }

NOT_DONE(GetFloat32)
NOT_DONE(GetInt8)
NOT_DONE(GetUInt8)
NOT_DONE(GetInt16)
NOT_DONE(GetUInt16)
NOT_DONE(GetInt32)
NOT_DONE(GetUInt32)
NOT_DONE(GetInt64)
NOT_DONE(GetUInt64)
NOT_DONE(GetString)
NOT_DONE(GetBinary)
NOT_DONE(GetClock)
NOT_DONE(SetFloat32)
NOT_DONE(SetInt8)
NOT_DONE(SetUInt8)
NOT_DONE(SetInt16)
NOT_DONE(SetUInt16)
NOT_DONE(SetInt32)
NOT_DONE(SetUInt32)
NOT_DONE(SetInt64)
NOT_DONE(SetUInt64)
NOT_DONE(SetString)
NOT_DONE(SetBinary)
NOT_DONE(SetClock)
NOT_DONE(GetNumberOfVariableDependencies)
NOT_DONE(GetVariableDependencies)
NOT_DONE(GetDirectionalDerivative)
NOT_DONE(GetAdjointDerivative)
NOT_DONE(EnterConfigurationMode)
NOT_DONE(ExitConfigurationMode)
NOT_DONE(GetIntervalDecimal)
NOT_DONE(GetIntervalFraction)
NOT_DONE(GetShiftDecimal)
NOT_DONE(GetShiftFraction)
NOT_DONE(SetIntervalDecimal)
NOT_DONE(SetIntervalFraction)
NOT_DONE(SetShiftDecimal)
NOT_DONE(SetShiftFraction)
NOT_DONE(EvaluateDiscreteStates)
NOT_DONE(UpdateDiscreteStates)
NOT_DONE(EnterEventMode)
NOT_DONE(EnterContinuousTimeMode)
NOT_DONE(CompletedIntegratorStep)
NOT_DONE(SetTime)
NOT_DONE(SetContinuousStates)
NOT_DONE(GetContinuousStateDerivatives)
NOT_DONE(GetEventIndicators)
NOT_DONE(GetContinuousStates)
NOT_DONE(GetNominalsOfContinuousStates)
NOT_DONE(GetNumberOfEventIndicators)
NOT_DONE(GetNumberOfContinuousStates)
NOT_DONE(GetOutputDerivatives)
NOT_DONE(ActivateModelPartition)
