/* One instance of an FMU: the followers of a case behind variables by number, alike for both versions of FMI. */
#ifndef CAMROLLER_FMI_INSTANCE_H
#define CAMROLLER_FMI_INSTANCE_H

#include <camroller.h>

#define HIDDEN __attribute__((visibility("hidden")))

typedef struct instance instance;
typedef struct state state;

/* Who hears of errors, and of remarks, with which an instance goes on */
typedef void (*listener)(void *who, int is_error, const char *message);

/* Every call returns 1, or 0 after the listener has heard why not. Numbers of variables are those of the model description, which the
 * token tells apart from others. */
HIDDEN instance *instance_new(const char *resources, const char *token, listener tell, void *who);
HIDDEN void instance_free(instance *self);
HIDDEN int instance_reset(instance *self);
HIDDEN int instance_get(instance *self, unsigned number, double *value);
HIDDEN int instance_set(instance *self, unsigned number, double value);
/* The end of the initialisation: the case is made of the parameters, its followers are put at their start. Remarks on its deck are
 * told. */
HIDDEN int instance_start(instance *self, double time);
/* Remarks on steps are told once of each kind. */
HIDDEN int instance_step(instance *self, double time, double length);
/* Say that something cannot be. */
HIDDEN int instance_refuse(instance *self, const char *message);

/* All that an instance remembers: `place` holds a state, or NULL for one to be made. */
HIDDEN int state_take(instance *self, state **place);
HIDDEN int state_put_back(instance *self, const state *kept);
HIDDEN void state_free(state *kept);
HIDDEN size_t state_size(instance *self, const state *kept);
HIDDEN int state_to_bytes(instance *self, const state *kept, char *bytes, size_t room);
/* `place` gets the state, whatever it held */
HIDDEN int state_from_bytes(instance *self, const char *bytes, size_t count, state **place);

#endif
