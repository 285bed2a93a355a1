/* One instance of an FMU. What the numbers of its variables mean is read from a file beside its deck, which `camroller fmu` writes
 * together with the model description: a line with the token of that description, then one for each variable, its kind, cam and place,
 * its key or the name of its number, and its value at the start. */
#define _POSIX_C_SOURCE 200809L /* for newlocale */
#include "instance.h"

#include <locale.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Kinds of variables, by the first word of their line */
enum kind {
   TIME, SPEED, SPEED_SLOPE, TEMPERATURE, TEMPERATURE_SLOPE, START_ANGLE, HAS_PRESSURE, PRESSURE, PRESSURE_SLOPE,
   HAS_SUPPLY, SUPPLY, SUPPLY_SLOPE, KEY,
   CAM_ANGLE, MEAN_DRIVE, MEAN_FRICTION, MEAN_BEARINGS, SMALLEST_DRIVE, LARGEST_DRIVE, ESTIMATED_ERROR, SERIES, KINDS
};
static const char *const words[KINDS] = {
   "time", "speed", "speed_slope", "oil_temperature", "oil_temperature_slope", "start_angle", "has_pressure", "gas_pressure",
   "gas_pressure_slope", "has_supply", "supply_pressure", "supply_pressure_slope", "key", "cam_angle", "mean_torque_drive", "mean_torque_friction", "mean_torque_bearings",
   "smallest_torque_drive", "largest_torque_drive", "estimated_error", "series"
};

enum { KEY_ROOM = 96, PATH_ROOM = 4096, LINE_ROOM = 256, NUMBER_ROOM = 32, MESSAGE_ROOM = 1024, KIND_ROOM = 64, KINDS_ROOM = 16 };

typedef struct {
   enum kind kind;
   int cam, place;
   char key[KEY_ROOM]; /* or the name of a number of the series */
   double start;
} variable;

struct state {
   double time;
   double *values;         /* of all variables */
   camroller_shaft *shaft; /* NULL before the start */
};

struct instance {
   char resources[PATH_ROOM];
   listener tell;
   void *who;
   variable *variables;
   size_t count;
   int cams;
   double *pressures, *row; /* room for pressures of all cams, and for the numbers of one */
   size_t row_room;
   int is_told[2];                      /* of inputs that do not count */
   char told[KINDS_ROOM][KIND_ROOM]; /* kinds of remarks on steps that have been told */
   state now;
   camroller_error error;
};

int instance_refuse(instance *self, const char *message) {
   self->tell(self->who, 1, message);
   return 0;
}

/* Was a call of the library right? */
static int heard(instance *self, int code) {
   return code == 0 ? 1 : instance_refuse(self, self->error.message);
}

/* Numbers have a point between their digits, whatever the host's locale has: what this thread reads and writes until the other call
 * is in the locale "C". */
static locale_t begin_c_locale(locale_t *made) {
   *made = newlocale(LC_ALL_MASK, "C", (locale_t)0);
   return *made == (locale_t)0 ? (locale_t)0 : uselocale(*made);
}

static void end_c_locale(locale_t before, locale_t made) {
   if (made == (locale_t)0) return;
   uselocale(before);
   freelocale(made);
}

/* Is an instance made with the token of the description that was written with the file? Else its numbers may mean something else. */
static int check_token(instance *self, FILE *file, const char *token) {
   char line[LINE_ROOM], own[LINE_ROOM];
   if (fgets(line, sizeof line, file) == NULL || sscanf(line, "token %255s", own) != 1)
      return instance_refuse(self, "resources/variables.txt of the FMU is damaged");
   if (token != NULL && strcmp(own, token) == 0) return 1;
   return instance_refuse(self, "the token, in FMI 2 the GUID, is not that of the FMU: model description and resources are of "
                                "different FMUs");
}

static int read_variables(instance *self, const char *token) {
   char path[PATH_ROOM + 32], line[LINE_ROOM], word[32];
   size_t room = 0;
   snprintf(path, sizeof path, "%s/variables.txt", self->resources);
   FILE *file = fopen(path, "r");
   if (file == NULL) return instance_refuse(self, "the FMU has no resources/variables.txt");
   if (!check_token(self, file, token)) {
      fclose(file);
      return 0;
   }
   locale_t made_locale, before = begin_c_locale(&made_locale);
   while (fgets(line, sizeof line, file) != NULL) {
      variable made = {KINDS, 0, 0, "", 0.0};
      if (sscanf(line, "%31s %d %d %95s %lf", word, &made.cam, &made.place, made.key, &made.start) != 5) break;
      for (made.kind = TIME; made.kind < KINDS && strcmp(word, words[made.kind]) != 0; made.kind++) continue;
      if (made.kind == KINDS) break;
      if (self->count == room) {
         room = 2 * room + 64;
         variable *larger = realloc(self->variables, room * sizeof *larger);
         if (larger == NULL) break;
         self->variables = larger;
      }
      if (made.cam > self->cams) self->cams = made.cam;
      if ((size_t)made.place >= self->row_room) self->row_room = (size_t)made.place + 1;
      self->variables[self->count++] = made;
   }
   end_c_locale(before, made_locale);
   int is_whole = feof(file);
   fclose(file);
   return is_whole && self->count > 0 ? 1 : instance_refuse(self, "resources/variables.txt of the FMU is damaged");
}

static void set_starts(instance *self) {
   for (size_t i = 0; i < self->count; i++) self->now.values[i] = self->variables[i].start;
}

/* The OpenBLAS has no threads of its own: that of the FMU, or of the process where it has one of that name already. */
static void settle_blas(void) {
   camroller_use_one_blas_thread();
}

instance *instance_new(const char *resources, const char *token, listener tell, void *who) {
   static pthread_once_t is_settled = PTHREAD_ONCE_INIT;
   instance *self = calloc(1, sizeof *self);
   if (self == NULL) return NULL;
   pthread_once(&is_settled, settle_blas);
   self->tell = tell;
   self->who = who;
   self->error.size = sizeof self->error;
   snprintf(self->resources, sizeof self->resources, "%s", resources);
   size_t length = strlen(self->resources);
   while (length > 1 && self->resources[length - 1] == '/') self->resources[--length] = 0;
   if (read_variables(self, token)) {
      self->now.values = malloc(self->count * sizeof(double));
      self->pressures = malloc((2 * (size_t)self->cams + 2) * sizeof(double));
      self->row = calloc(self->row_room + 1, sizeof(double));
      if (self->now.values != NULL && self->pressures != NULL && self->row != NULL) {
         set_starts(self);
         return self;
      }
      instance_refuse(self, "there is no memory for the FMU");
   }
   instance_free(self);
   return NULL;
}

void instance_free(instance *self) {
   if (self == NULL) return;
   camroller_shaft_free(self->now.shaft);
   free(self->now.values);
   free(self->variables);
   free(self->pressures);
   free(self->row);
   free(self);
}

int instance_reset(instance *self) {
   camroller_shaft_free(self->now.shaft);
   self->now.shaft = NULL;
   self->now.time = 0.0;
   memset(self->is_told, 0, sizeof self->is_told);
   memset(self->told, 0, sizeof self->told);
   set_starts(self);
   return 1;
}

int instance_get(instance *self, unsigned number, double *value) {
   if (number >= self->count) return instance_refuse(self, "there is no variable of that number");
   *value = self->variables[number].kind == TIME ? self->now.time : self->now.values[number];
   return 1;
}

int instance_set(instance *self, unsigned number, double value) {
   if (number >= self->count) return instance_refuse(self, "there is no variable of that number");
   switch (self->variables[number].kind) {
   case SPEED: case SPEED_SLOPE: case TEMPERATURE: case TEMPERATURE_SLOPE: case PRESSURE: case PRESSURE_SLOPE: case SUPPLY:
   case SUPPLY_SLOPE:
      break;
   case START_ANGLE: case HAS_PRESSURE: case HAS_SUPPLY: case KEY:
      if (self->now.shaft != NULL) return instance_refuse(self, "parameters can be set before the end of the initialisation only");
      break;
   default:
      return instance_refuse(self, "outputs cannot be set");
   }
   self->now.values[number] = value;
   return 1;
}

/* The case of the FMU with the parameters of a state; NULL where there is an error */
static camroller_case *case_of(instance *self, const double *values) {
   char path[PATH_ROOM + 32], (*texts)[NUMBER_ROOM] = malloc(self->count * sizeof *texts);
   const char **keys = malloc(self->count * sizeof *keys), **words = malloc(self->count * sizeof *words);
   camroller_case *made = NULL;
   size_t count = 0;
   int is_right = texts != NULL && keys != NULL && words != NULL ? 1 : instance_refuse(self, "there is no memory for the parameters");
   snprintf(path, sizeof path, "%s/deck.nml", self->resources);
   is_right = is_right && heard(self, camroller_case_from_file(path, &made, &self->error));
   locale_t made_locale, before = begin_c_locale(&made_locale);
   for (size_t i = 0; is_right && i < self->count; i++) {
      if (self->variables[i].kind != KEY || values[i] == self->variables[i].start) continue;
      snprintf(texts[count], sizeof *texts, "%.17g", values[i]);
      keys[count] = self->variables[i].key;
      words[count] = texts[count];
      count++;
   }
   end_c_locale(before, made_locale);
   is_right = is_right && heard(self, camroller_case_set_all(made, count, keys, words, &self->error));
   free(texts);
   free(keys);
   free(words);
   if (is_right) return made;
   camroller_case_free(made);
   return NULL;
}

/* Value of the only variable of a kind, or of that of a cam; 0 where there is none */
static double value_of(const instance *self, enum kind kind, int cam) {
   for (size_t i = 0; i < self->count; i++)
      if (self->variables[i].kind == kind && self->variables[i].cam == cam) return self->now.values[i];
   return 0.0;
}

/* Does a shaft have the cams and the numbers that the model description promises? Some keys decide which there are. */
static int has_described(const instance *self, const camroller_shaft *shaft) {
   char name[KEY_ROOM], *const texts[3] = {name, NULL, NULL};
   if (camroller_shaft_cams(shaft) != self->cams) return 0;
   for (size_t i = 0; i < self->count; i++) {
      const variable *one = &self->variables[i];
      if (one->kind != SERIES) continue;
      if (camroller_shaft_quantity(shaft, one->cam, (size_t)one->place, texts, sizeof name, NULL) != 0) return 0;
      if (strcmp(name, one->key) != 0) return 0;
      int is_last = i + 1 == self->count || self->variables[i + 1].kind != SERIES || self->variables[i + 1].cam != one->cam;
      if (is_last && camroller_shaft_quantity(shaft, one->cam, (size_t)one->place + 1, NULL, 0, NULL) == 0) return 0;
   }
   return 1;
}

/* Refuse parameters that change which outputs there are, by their names. */
static int refuse_outputs(instance *self, const double *values) {
   char message[MESSAGE_ROOM] = "";
   for (size_t i = 0; i < self->count; i++) {
      if (self->variables[i].kind != KEY || values[i] == self->variables[i].start) continue;
      size_t used = strlen(message);
      snprintf(message + used, sizeof message - used, "%s%s", used == 0 ? "" : ", ", self->variables[i].key);
   }
   size_t used = strlen(message);
   snprintf(message + used, sizeof message - used, ": with such values there are other outputs than the FMU has; one that has them is "
                                                   "written by 'camroller fmu DECK --set KEY=VALUE'");
   return instance_refuse(self, message);
}

int instance_start(instance *self, double time) {
   char remarks[sizeof self->error.message];
   camroller_case *made = case_of(self, self->now.values);
   if (made == NULL) return 0;
   camroller_case_remarks(made, remarks, sizeof remarks);
   if (remarks[0] != 0) self->tell(self->who, 0, remarks);
   camroller_shaft_free(self->now.shaft);
   self->now.shaft = NULL;
   int is_right = heard(self, camroller_shaft_new(made, value_of(self, START_ANGLE, 0), 1, &self->now.shaft, &self->error));
   camroller_case_free(made);
   if (is_right && !has_described(self, self->now.shaft)) {
      camroller_shaft_free(self->now.shaft);
      self->now.shaft = NULL;
      is_right = refuse_outputs(self, self->now.values);
   }
   self->now.time = time;
   return is_right;
}

/* Outputs after a step */
static int take_outputs(instance *self, const camroller_shaft_outcome *outcome) {
   int cam = -1;
   for (size_t i = 0; i < self->count; i++) {
      const variable *one = &self->variables[i];
      double *value = &self->now.values[i];
      switch (one->kind) {
      case CAM_ANGLE: *value = camroller_shaft_angle(self->now.shaft); break;
      case MEAN_DRIVE: *value = outcome->mean_torque_drive; break;
      case MEAN_FRICTION: *value = outcome->mean_torque_friction; break;
      case MEAN_BEARINGS: *value = outcome->mean_torque_bearings; break;
      case SMALLEST_DRIVE: *value = outcome->extreme_torque[0]; break;
      case LARGEST_DRIVE: *value = outcome->extreme_torque[1]; break;
      case ESTIMATED_ERROR: *value = outcome->estimated_error; break;
      case SERIES:
         if (one->cam != cam) {
            cam = one->cam;
            if (!heard(self, camroller_shaft_values(self->now.shaft, cam, self->row, self->row_room, &self->error))) return 0;
         }
         *value = self->row[one->place];
         break;
      default: break;
      }
   }
   return 1;
}

/* Has an importer given variables of a kind other values than those at the start? */
static int is_given(const instance *self, enum kind kind) {
   for (size_t i = 0; i < self->count; i++)
      if (self->variables[i].kind == kind && self->now.values[i] != self->variables[i].start) return 1;
   return 0;
}

/* Tell once of inputs that are given but do not count. */
static void tell_unused(instance *self) {
   static const struct {
      enum kind has, value, slope;
      const char *message;
   } inputs[] = {
      {HAS_PRESSURE, PRESSURE, PRESSURE_SLOPE,
       "the gas pressures of the inputs are not used: the parameter gas_pressure_is_input is false, so that the deck's pressure counts"},
      {HAS_SUPPLY, SUPPLY, SUPPLY_SLOPE,
       "the supply pressure of the input is not used: the parameter supply_pressure_is_input is false, so that the deck's counts"},
   };
   for (size_t i = 0; i < sizeof inputs / sizeof *inputs; i++) {
      if (self->is_told[i] || value_of(self, inputs[i].has, 0) != 0.0) continue;
      if (!is_given(self, inputs[i].value) && !is_given(self, inputs[i].slope)) continue;
      self->tell(self->who, 0, inputs[i].message);
      self->is_told[i] = 1;
   }
}

/* Tell of each kind of remark on steps once, with its first remark. */
static void tell_remarks(instance *self) {
   char kind[MESSAGE_ROOM], words[MESSAGE_ROOM];
   char *const texts[2] = {kind, words};
   for (size_t number = 0; camroller_shaft_remark(self->now.shaft, number, texts, MESSAGE_ROOM, NULL) == 0; number++) {
      int place = 0;
      while (place < KINDS_ROOM && self->told[place][0] != 0 && strncmp(self->told[place], kind, KIND_ROOM - 1) != 0) place++;
      if (place == KINDS_ROOM || self->told[place][0] != 0) continue;
      strncpy(self->told[place], kind, KIND_ROOM - 1);
      self->tell(self->who, 0, words);
   }
}

int instance_step(instance *self, double time, double length) {
   camroller_shaft_outcome outcome = {.size = sizeof outcome};
   camroller_inputs start = {.size = sizeof start}, end = {.size = sizeof end};
   if (self->now.shaft == NULL) return instance_refuse(self, "a step needs an instance that is initialised");
   if (!(isfinite(length) && length > 0.0)) return instance_refuse(self, "the length of a step must be finite and above zero");
   if (!(fabs(time - self->now.time) <= 1e-9 * (1.0 + fabs(time))))
      return instance_refuse(self, "a step must start where the one before ended, or a state of that time be set");
   start.speed = value_of(self, SPEED, 0);
   end.speed = start.speed + value_of(self, SPEED_SLOPE, 0) * length;
   if (!(start.speed > 0.0 && end.speed > 0.0))
      return instance_refuse(self, "the speed must be above zero at both ends of a step: a cam does not turn backward, and an engine "
                                   "that stands makes no steps; where it turns again, reset the FMU and initialise it at that time "
                                   "with that start_angle");
   tell_unused(self);
   start.oil_temperature = value_of(self, TEMPERATURE, 0);
   end.oil_temperature = start.oil_temperature + value_of(self, TEMPERATURE_SLOPE, 0) * length;
   start.has_supply = end.has_supply = value_of(self, HAS_SUPPLY, 0) != 0.0;
   if (start.has_supply) {
      start.supply_pressure = value_of(self, SUPPLY, 0);
      end.supply_pressure = start.supply_pressure + value_of(self, SUPPLY_SLOPE, 0) * length;
   }
   int has_pressure = value_of(self, HAS_PRESSURE, 0) != 0.0;
   for (int cam = 1; cam <= self->cams && has_pressure; cam++) {
      self->pressures[cam - 1] = value_of(self, PRESSURE, cam);
      self->pressures[self->cams + cam - 1] = self->pressures[cam - 1] + value_of(self, PRESSURE_SLOPE, cam) * length;
   }
   double angle = camroller_shaft_angle(self->now.shaft) + 0.5 * (start.speed + end.speed) * length;
   if (!heard(self, camroller_shaft_step(self->now.shaft, angle, &start, &end, has_pressure ? self->pressures : NULL, &outcome,
                                         &self->error)))
      return 0;
   self->now.time = time + length;
   tell_remarks(self);
   return take_outputs(self, &outcome);
}

int state_take(instance *self, state **place) {
   state *made = calloc(1, sizeof *made);
   if (made == NULL || (made->values = malloc(self->count * sizeof(double))) == NULL) {
      free(made);
      return instance_refuse(self, "there is no memory for a state");
   }
   made->time = self->now.time;
   memcpy(made->values, self->now.values, self->count * sizeof(double));
   if (self->now.shaft != NULL && !heard(self, camroller_shaft_copy(self->now.shaft, &made->shaft, &self->error))) {
      state_free(made);
      return 0;
   }
   state_free(*place);
   *place = made;
   return 1;
}

int state_put_back(instance *self, const state *kept) {
   camroller_shaft *copy = NULL;
   if (kept->shaft != NULL && !heard(self, camroller_shaft_copy(kept->shaft, &copy, &self->error))) return 0;
   camroller_shaft_free(self->now.shaft);
   self->now.shaft = copy;
   self->now.time = kept->time;
   memcpy(self->now.values, kept->values, self->count * sizeof(double));
   return 1;
}

void state_free(state *kept) {
   if (kept == NULL) return;
   camroller_shaft_free(kept->shaft);
   free(kept->values);
   free(kept);
}

/* Bytes of a state: time, values, then the block of the followers where there are any */
size_t state_size(instance *self, const state *kept) {
   return (self->count + 1) * sizeof(double) + camroller_shaft_save_size(kept->shaft);
}

int state_to_bytes(instance *self, const state *kept, char *bytes, size_t room) {
   size_t numbers = self->count * sizeof(double), head = numbers + sizeof(double);
   if (room < state_size(self, kept)) return instance_refuse(self, "there is room for fewer bytes than the state has");
   memcpy(bytes, &kept->time, sizeof(double));
   memcpy(bytes + sizeof(double), kept->values, numbers);
   return kept->shaft == NULL || heard(self, camroller_shaft_save(kept->shaft, bytes + head, room - head, &self->error));
}

int state_from_bytes(instance *self, const char *bytes, size_t count, state **place) {
   size_t numbers = self->count * sizeof(double), head = numbers + sizeof(double);
   if (count < head) return instance_refuse(self, "the bytes are not those of a state of this FMU");
   state *made = calloc(1, sizeof *made);
   if (made == NULL || (made->values = malloc(numbers)) == NULL) {
      free(made);
      return instance_refuse(self, "there is no memory for a state");
   }
   memcpy(&made->time, bytes, sizeof(double));
   memcpy(made->values, bytes + sizeof(double), numbers);
   if (count > head) {
      camroller_case *own = case_of(self, made->values);
      int is_right = own != NULL && heard(self, camroller_shaft_restore(own, bytes + head, count - head, 1, &made->shaft,
                                                                        &self->error));
      camroller_case_free(own);
      if (is_right && !has_described(self, made->shaft)) is_right = refuse_outputs(self, made->values);
      if (!is_right) {
         state_free(made);
         return 0;
      }
   }
   *place = made;
   return 1;
}
