/* Every call of the C interface, with right arguments, with NULL and with what must be refused. Ends with 0 where all is right.
 *
 * Usage: interface DECK CAMSHAFT          decks with one cam, and with three
 *        interface DECK --restore BLOCK   a follower is restored from that file, or saved there, and stepped; its numbers are printed */
#define _GNU_SOURCE /* for fegetexcept */
#include <camroller.h>
#include <fenv.h>
#include <float.h>
#include <locale.h>
#include <math.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static int failures = 0;

#define CHECK(condition) \
   do { \
      if (!(condition)) { \
         failures++; \
         fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #condition); \
      } \
   } while (0)

/* A call with these arguments is refused with a code and a message that names a word; with the code alone where nobody listens */
#define REFUSED(kind, word, call, ...) \
   do { \
      error.message[0] = 0; \
      CHECK(call(__VA_ARGS__, &error) == (kind)); \
      CHECK(error.code == (kind)); \
      CHECK(strstr(error.message, word) != NULL); \
      CHECK(call(__VA_ARGS__, NULL) == (kind)); \
   } while (0)

static camroller_error error = {sizeof error, 0, 0, ""};
static const double turn_angle = 6.283185307179586;

static char *read_all(const char *path) {
   FILE *file = fopen(path, "rb");
   char *text = calloc(1, 1 << 20);
   if (file == NULL || fread(text, 1, (1 << 20) - 1, file) == 0) exit(9);
   fclose(file);
   return text;
}

/* What a library must leave alone: handlers and mask of signals, rounding, traps, denormal numbers, locale, folder, environment */
static void note_settings(char *text) {
   struct sigaction action;
   sigset_t blocked;
   volatile double tiny = DBL_MIN;
   sigprocmask(SIG_BLOCK, NULL, &blocked);
   for (int number = 1; number < NSIG; number++)
      if (sigaction(number, NULL, &action) == 0)
         text += sprintf(text, "%d %p %d\n", number, (void *)action.sa_handler, sigismember(&blocked, number));
   text += sprintf(text, "%d %d %d %s ", fegetround(), fegetexcept(), tiny / 2 > 0, setlocale(LC_ALL, NULL));
   text += strlen(getcwd(text, 4096));
   for (char **variable = environ; *variable != NULL; variable++) text += sprintf(text, "\n%.400s", *variable);
}

static camroller_inputs inputs(double speed) {
   camroller_inputs made = {.size = sizeof made, .speed = speed, .oil_temperature = 333.15};
   return made;
}

/* Steps that anyone who has the follower makes the same */
static void drive(camroller_simulation *self, double *sum) {
   camroller_inputs start = inputs(30.0), end = inputs(31.0);
   camroller_outcome outcome = {.size = sizeof outcome};
   double from = camroller_simulation_angle(self);
   *sum = 0.0;
   for (int i = 1; i <= 50; i++) {
      CHECK(camroller_simulation_step(self, from + 0.1 * i, &start, &end, &outcome, &error) == 0);
      *sum += outcome.mean_torque_drive + outcome.torque_friction;
   }
}

static void test_version(void) {
   char text[32], small[3];
   CHECK(camroller_library_version() == CAMROLLER_VERSION);
   camroller_library_version_text(text, sizeof text);
   CHECK(strchr(text, '.') != NULL);
   camroller_library_version_text(small, sizeof small);
   CHECK(strlen(small) == 2 && strncmp(small, text, 2) == 0);
   camroller_library_version_text(NULL, 10);
   camroller_library_version_text(text, 0);
   /* whether the linear algebra is OpenBLAS is known to who built the library */
   int is_done = camroller_use_one_blas_thread();
   CHECK(is_done == 0 || is_done == 1);
}

static camroller_case *test_case(const char *path) {
   camroller_case *from_file = NULL, *from_text = NULL, *none = NULL;
   char *text = read_all(path);
   CHECK(camroller_case_from_file(path, &from_file, &error) == 0 && from_file != NULL);
   CHECK(camroller_case_from_text(text, "decks", &from_text, NULL) == 0 && from_text != NULL);
   REFUSED(CAMROLLER_FILE, "no such deck", camroller_case_from_file, "no such deck", &none);
   REFUSED(CAMROLLER_USAGE, "'path'", camroller_case_from_file, NULL, &none);
   REFUSED(CAMROLLER_USAGE, "'out'", camroller_case_from_file, path, NULL);
   REFUSED(CAMROLLER_USAGE, "'text'", camroller_case_from_text, NULL, NULL, &none);
   REFUSED(CAMROLLER_USAGE, "'out'", camroller_case_from_text, "", NULL, NULL);
   REFUSED(CAMROLLER_DECK, "text:1:", camroller_case_from_text, "&lift law = 3 /", NULL, &none);
   CHECK(none == NULL);
   CHECK(camroller_case_from_text("&lift law = 3 /", NULL, &none, NULL) == CAMROLLER_DECK);
   camroller_error old = {sizeof(size_t), 77, 0, ""};
   CHECK(camroller_case_from_text("&lift law = 3 /", NULL, &none, &old) == CAMROLLER_DECK && old.code == 77);
   CHECK(camroller_case_set(from_text, "operating_point.speed_rpm", "900", &error) == 0);
   REFUSED(CAMROLLER_DECK, "speed_rpm", camroller_case_set, from_text, "operating_point.speed", "900");
   REFUSED(CAMROLLER_USAGE, "'camroller_case'", camroller_case_set, NULL, "a.b", "1");
   REFUSED(CAMROLLER_USAGE, "'key'", camroller_case_set, from_text, NULL, "1");
   REFUSED(CAMROLLER_USAGE, "'value'", camroller_case_set, from_text, "a.b", NULL);
   /* a thicker wall needs the thinner needles */
   const char *keys[] = {"roller.wall_thickness_mm", "needle_bearing.needle_radius_mm"}, *words[] = {"6.6", "0.7"}, *holes[] = {"a.b", NULL};
   REFUSED(CAMROLLER_DECK, "wall_thickness_mm", camroller_case_set, from_text, keys[0], words[0]);
   CHECK(camroller_case_set_all(from_text, 2, keys, words, &error) == 0);
   CHECK(camroller_case_set_all(from_text, 0, keys, words, NULL) == 0);
   REFUSED(CAMROLLER_USAGE, "'camroller_case'", camroller_case_set_all, NULL, 2, keys, words);
   REFUSED(CAMROLLER_USAGE, "'keys'", camroller_case_set_all, from_text, 2, NULL, words);
   REFUSED(CAMROLLER_USAGE, "'values'", camroller_case_set_all, from_text, 2, keys, NULL);
   REFUSED(CAMROLLER_USAGE, "'key'", camroller_case_set_all, from_text, 2, holes, words);
   REFUSED(CAMROLLER_USAGE, "'value'", camroller_case_set_all, from_text, 2, keys, holes);
   CHECK(camroller_case_check(from_text, &error) == 0);
   REFUSED(CAMROLLER_USAGE, "NULL", camroller_case_check, NULL);
   CHECK(camroller_case_set(from_text, "roller.radius_mm", "60", &error) == 0);
   CHECK(camroller_case_check(from_text, &error) != 0 && strstr(error.message, "radius_mm") != NULL);
   camroller_case_free(from_text);
   camroller_case_free(NULL);
   free(text);
   return from_file;
}

static void test_result(const camroller_case *self) {
   camroller_result *result = NULL;
   double torque = 0.0, *angle, *friction, sum = 0.0;
   char name[64], unit[32], meaning[200], *texts[3] = {name, unit, meaning}, *nothing[3] = {NULL, NULL, NULL}, remarks[4000];
   size_t rows, count = 0;
   REFUSED(CAMROLLER_USAGE, "'camroller_case'", camroller_case_run, NULL, &result);
   REFUSED(CAMROLLER_USAGE, "'out'", camroller_case_run, self, NULL);
   CHECK(camroller_case_run(self, &result, &error) == 0 && error.code == 0 && error.message[0] == 0);
   CHECK(camroller_result_scalar(result, "mean_torque_friction", &torque, &error) == 0 && torque > 0.0);
   REFUSED(CAMROLLER_USAGE, "no_such", camroller_result_scalar, result, "no_such", &torque);
   CHECK(torque > 0.0); /* a call that is refused leaves what it would have filled */
   REFUSED(CAMROLLER_USAGE, "NULL", camroller_result_scalar, NULL, "a", &torque);
   REFUSED(CAMROLLER_USAGE, "'name'", camroller_result_scalar, result, NULL, &torque);
   REFUSED(CAMROLLER_USAGE, "'value'", camroller_result_scalar, result, "a", NULL);
   rows = camroller_result_rows(result);
   CHECK(rows > 100 && camroller_result_rows(NULL) == 0);
   angle = malloc(rows * sizeof *angle);
   friction = malloc(rows * sizeof *friction);
   CHECK(camroller_result_series(result, "cam_angle", angle, rows, &error) == 0);
   CHECK(angle[0] == 0.0 && fabs(angle[rows - 1] - turn_angle) < 0.1);
   CHECK(camroller_result_series(result, "torque_friction", friction, rows, &error) == 0);
   for (size_t i = 0; i < rows; i++) sum += friction[i] / rows;
   CHECK(fabs(sum - torque) < 0.1 * torque);
   REFUSED(CAMROLLER_USAGE, "room", camroller_result_series, result, "torque_friction", friction, rows - 1);
   REFUSED(CAMROLLER_USAGE, "no_such", camroller_result_series, result, "no_such", friction, rows);
   REFUSED(CAMROLLER_USAGE, "NULL", camroller_result_series, NULL, "a", friction, rows);
   REFUSED(CAMROLLER_USAGE, "'name'", camroller_result_series, result, NULL, friction, rows);
   REFUSED(CAMROLLER_USAGE, "'values'", camroller_result_series, result, "a", NULL, rows);
   CHECK(camroller_result_unit(result, "torque_friction", unit, sizeof unit, &error) == 0 && strcmp(unit, "N m") == 0);
   CHECK(camroller_result_unit(result, "cam_angle", unit, sizeof unit, &error) == 0 && strcmp(unit, "rad") == 0);
   CHECK(camroller_result_unit(result, "mean_torque_friction", unit, sizeof unit, &error) == 0);
   REFUSED(CAMROLLER_USAGE, "no_such", camroller_result_unit, result, "no_such", unit, sizeof unit);
   REFUSED(CAMROLLER_USAGE, "NULL", camroller_result_unit, NULL, "a", unit, sizeof unit);
   REFUSED(CAMROLLER_USAGE, "'name'", camroller_result_unit, result, NULL, unit, sizeof unit);
   REFUSED(CAMROLLER_USAGE, "'buffer'", camroller_result_unit, result, "a", NULL, 0);
   for (int kind = 0; kind < 2; kind++)
      for (size_t i = 0; camroller_result_quantity(result, kind, i, texts, sizeof unit, NULL) == 0; i++) count++;
   CHECK(count > 50);
   CHECK(camroller_result_quantity(result, 0, 0, nothing, 0, &error) == 0);
   CHECK(camroller_result_quantity(result, 0, 0, NULL, 0, &error) == 0);
   REFUSED(CAMROLLER_USAGE, "number", camroller_result_quantity, result, 0, SIZE_MAX, texts, 10);
   REFUSED(CAMROLLER_USAGE, "number", camroller_result_quantity, result, 2, 0, texts, 10);
   REFUSED(CAMROLLER_USAGE, "NULL", camroller_result_quantity, NULL, 0, 0, texts, 10);
   camroller_result_remarks(result, remarks, sizeof remarks);
   camroller_result_remarks(NULL, remarks, sizeof remarks);
   CHECK(remarks[0] == 0);
   camroller_result_remarks(result, NULL, 0);
   camroller_result_free(result);
   camroller_result_free(NULL);
   free(angle);
   free(friction);
}

static void test_simulation(const camroller_case *self) {
   camroller_simulation *simulation = NULL, *copy = NULL, *restored = NULL;
   camroller_inputs start = inputs(30.0), end = inputs(31.0), wrong = inputs(0.0), pressed = inputs(31.0);
   camroller_outcome outcome = {.size = sizeof outcome}, small = {.size = 8};
   char kind[64], sentence[64], *texts[2] = {kind, sentence};
   double value, sums[3];
   size_t bytes = camroller_simulation_save_size(), count = 0;
   char *block = malloc(bytes);
   REFUSED(CAMROLLER_USAGE, "'camroller_case'", camroller_simulation_new, NULL, 1, 0.0, &simulation);
   REFUSED(CAMROLLER_USAGE, "'out'", camroller_simulation_new, self, 1, 0.0, NULL);
   REFUSED(CAMROLLER_USAGE, "second_lift", camroller_simulation_new, self, 2, 0.0, &simulation);
   REFUSED(CAMROLLER_USAGE, "finite", camroller_simulation_new, self, 1, INFINITY, &simulation);
   CHECK(simulation == NULL);
   CHECK(camroller_simulation_new(self, 1, 1.0, &simulation, &error) == 0 && simulation != NULL);
   CHECK(camroller_simulation_angle(simulation) == 1.0 && camroller_simulation_angle(NULL) == 0.0);
   REFUSED(CAMROLLER_USAGE, "no step", camroller_simulation_value, simulation, "contact_load", &value);
   CHECK(camroller_simulation_step(simulation, 1.1, &start, &end, &outcome, &error) == 0);
   CHECK(outcome.mean_torque_friction > 0.0 && outcome.contact_load[0] <= outcome.contact_load[1]);
   CHECK(fabs(outcome.torques[0] + outcome.torques[1] + outcome.torques[2] + outcome.torques[3] + outcome.torques[4]
              + outcome.torque_others - outcome.torque_drive) < 1e-12);
   CHECK(camroller_simulation_value(simulation, "contact_load", &value, &error) == 0);
   CHECK(value > 0.0 && fabs(hypot(outcome.cam_force[0], outcome.cam_force[1]) / value - 1.0) < 0.1);
   CHECK(camroller_simulation_value(simulation, "torque_contact", &value, &error) == 0 && value == outcome.torques[1] && value > 0.0);
   REFUSED(CAMROLLER_USAGE, "torque_tip", camroller_simulation_value, simulation, "torque_tip", &value);
   REFUSED(CAMROLLER_USAGE, "torque_drive", camroller_simulation_value, simulation, "torque_drive", &value);
   for (size_t i = 0; camroller_simulation_remark(simulation, i, texts, sizeof kind, NULL) == 0; i++)
      CHECK(strcmp(kind, "oil far from its points") != 0);
   end.oil_temperature = 390.0;
   CHECK(camroller_simulation_step(simulation, 1.2, &start, &end, NULL, NULL) == 0);
   end.oil_temperature = start.oil_temperature;
   for (size_t i = 0; camroller_simulation_remark(simulation, i, texts, sizeof kind, &error) == 0; i++)
      if (strcmp(kind, "oil far from its points") == 0 && strstr(sentence, "oil temperature, 116.85 degC") != NULL) count++;
   CHECK(count == 1 && error.code == CAMROLLER_USAGE);
   CHECK(camroller_simulation_remark(simulation, 0, NULL, 0, &error) == 0);
   REFUSED(CAMROLLER_USAGE, "number", camroller_simulation_remark, simulation, SIZE_MAX, texts, 10);
   REFUSED(CAMROLLER_USAGE, "NULL", camroller_simulation_remark, NULL, 0, texts, 10);
   REFUSED(CAMROLLER_USAGE, "grow", camroller_simulation_step, simulation, 1.2, &start, &end, &outcome);
   REFUSED(CAMROLLER_USAGE, "speed", camroller_simulation_step, simulation, 1.3, &wrong, &end, &outcome);
   wrong.size = 1;
   REFUSED(CAMROLLER_USAGE, "size", camroller_simulation_step, simulation, 1.3, &wrong, &end, &outcome);
   REFUSED(CAMROLLER_USAGE, "size", camroller_simulation_step, simulation, 1.3, &start, &end, &small);
   REFUSED(CAMROLLER_USAGE, "NULL", camroller_simulation_step, NULL, 1.3, &start, &end, &outcome);
   REFUSED(CAMROLLER_USAGE, "'start'", camroller_simulation_step, simulation, 1.3, NULL, &end, &outcome);
   REFUSED(CAMROLLER_USAGE, "'finish'", camroller_simulation_step, simulation, 1.3, &start, NULL, &outcome);
   pressed.has_pressure = 1;
   REFUSED(CAMROLLER_USAGE, "&gas_force", camroller_simulation_step, simulation, 1.3, &pressed, &pressed, &outcome);
   REFUSED(CAMROLLER_USAGE, "no_such", camroller_simulation_value, simulation, "no_such", &value);
   REFUSED(CAMROLLER_USAGE, "NULL", camroller_simulation_value, NULL, "a", &value);
   REFUSED(CAMROLLER_USAGE, "'name'", camroller_simulation_value, simulation, NULL, &value);
   REFUSED(CAMROLLER_USAGE, "'value'", camroller_simulation_value, simulation, "a", NULL);

   CHECK(camroller_simulation_save(simulation, block, bytes, &error) == 0);
   REFUSED(CAMROLLER_USAGE, "small", camroller_simulation_save, simulation, block, bytes - 1);
   REFUSED(CAMROLLER_USAGE, "NULL", camroller_simulation_save, NULL, block, bytes);
   REFUSED(CAMROLLER_USAGE, "'buffer'", camroller_simulation_save, simulation, NULL, bytes);
   /* what cannot be made leaves NULL, not what was there */
   copy = (camroller_simulation *)block;
   REFUSED(CAMROLLER_USAGE, "NULL", camroller_simulation_copy, NULL, &copy);
   CHECK(copy == NULL);
   CHECK(camroller_simulation_copy(simulation, &copy, &error) == 0);
   REFUSED(CAMROLLER_USAGE, "'out'", camroller_simulation_copy, simulation, NULL);
   REFUSED(CAMROLLER_USAGE, "size", camroller_simulation_restore, self, block, bytes - 1, &restored);
   block[50] ^= 1;
   REFUSED(CAMROLLER_USAGE, "damaged", camroller_simulation_restore, self, block, bytes, &restored);
   block[50] ^= 1;
   block[0] ^= 1;
   REFUSED(CAMROLLER_USAGE, "not one", camroller_simulation_restore, self, block, bytes, &restored);
   block[0] ^= 1;
   REFUSED(CAMROLLER_USAGE, "NULL", camroller_simulation_restore, NULL, block, bytes, &restored);
   REFUSED(CAMROLLER_USAGE, "'buffer'", camroller_simulation_restore, self, NULL, bytes, &restored);
   REFUSED(CAMROLLER_USAGE, "'out'", camroller_simulation_restore, self, block, bytes, NULL);
   CHECK(restored == NULL);
   CHECK(camroller_simulation_restore(self, block, bytes, &restored, &error) == 0);
   drive(simulation, &sums[0]);
   drive(copy, &sums[1]);
   drive(restored, &sums[2]);
   CHECK(sums[0] == sums[1] && sums[0] == sums[2]);
   CHECK(camroller_simulation_halt(copy, &error) == 0);
   REFUSED(CAMROLLER_USAGE, "NULL", camroller_simulation_halt, NULL);
   drive(copy, &sums[1]);
   drive(simulation, &sums[0]);
   CHECK(sums[0] != sums[1]);
   camroller_simulation_free(simulation);
   camroller_simulation_free(copy);
   camroller_simulation_free(restored);
   camroller_simulation_free(NULL);
   free(block);
}

/* Numbers that the deck gives, cases of its sweep */
static void test_deck(const camroller_case *self) {
   camroller_case *copy = NULL, *varied = NULL;
   char name[64], unit[32], meaning[400], *texts[3] = {name, unit, meaning}, *few[2] = {name, unit}, *nothing[3] = {NULL, NULL, NULL};
   char remarks[2000];
   double value = 0.0;
   size_t count = 0, cases;
   REFUSED(CAMROLLER_USAGE, "NULL", camroller_case_copy, NULL, &copy);
   REFUSED(CAMROLLER_USAGE, "'out'", camroller_case_copy, self, NULL);
   CHECK(camroller_case_copy(self, &copy, &error) == 0);
   camroller_case_remarks(copy, remarks, sizeof remarks);
   CHECK(remarks[0] == 0);
   CHECK(camroller_case_set(copy, "roller.mass_kg", "5", &error) == 0);
   camroller_case_remarks(copy, remarks, sizeof remarks);
   CHECK(strstr(remarks, "roller.mass_kg") != NULL);
   camroller_case_remarks(NULL, remarks, sizeof remarks);
   CHECK(remarks[0] == 0);
   camroller_case_remarks(copy, NULL, 0);
   CHECK(camroller_case_set(copy, "roller.mass_kg", "0.5", &error) == 0);
   for (size_t i = 0; camroller_case_number(self, i, texts, sizeof unit, &value, &error) == 0; i++) {
      if (strcmp(name, "roller.mass_kg") == 0) CHECK(value > 0.0 && value < 0.5 && strcmp(unit, "kg") == 0);
      count++;
   }
   CHECK(count > 10 && error.code == CAMROLLER_USAGE);
   for (size_t i = 0; camroller_case_number(copy, i, texts, sizeof unit, &value, &error) == 0; i++)
      if (strcmp(name, "roller.mass_kg") == 0) CHECK(value == 0.5);
   CHECK(camroller_case_number(self, 0, nothing, 0, NULL, NULL) == 0);
   CHECK(camroller_case_number(self, 0, NULL, 0, &value, NULL) == 0);
   REFUSED(CAMROLLER_USAGE, "place", camroller_case_number, self, SIZE_MAX, texts, 10, &value);
   REFUSED(CAMROLLER_USAGE, "NULL", camroller_case_number, NULL, 0, texts, 10, &value);
   cases = camroller_case_sweep_size(self);
   CHECK(cases == 9 && camroller_case_sweep_size(NULL) == 0);
   CHECK(camroller_case_sweep_value(self, 8, 0, few, sizeof unit, &error) == 0 && strcmp(unit, "900") == 0);
   CHECK(strcmp(name, "operating_point.speed_rpm") == 0);
   CHECK(camroller_case_sweep_value(self, 8, 0, nothing, 0, &error) == 0);
   CHECK(camroller_case_sweep_value(self, 8, 0, NULL, 0, &error) == 0);
   REFUSED(CAMROLLER_USAGE, "case", camroller_case_sweep_value, self, SIZE_MAX, 0, few, 10);
   REFUSED(CAMROLLER_USAGE, "key", camroller_case_sweep_value, self, 0, SIZE_MAX, few, 10);
   REFUSED(CAMROLLER_USAGE, "case", camroller_case_sweep_case, self, SIZE_MAX, &varied);
   REFUSED(CAMROLLER_USAGE, "case", camroller_case_sweep_value, self, 9, 0, few, 10);
   REFUSED(CAMROLLER_USAGE, "key", camroller_case_sweep_value, self, 0, 2, few, 10);
   REFUSED(CAMROLLER_USAGE, "NULL", camroller_case_sweep_value, NULL, 0, 0, few, 10);
   REFUSED(CAMROLLER_USAGE, "case", camroller_case_sweep_case, self, 9, &varied);
   REFUSED(CAMROLLER_USAGE, "NULL", camroller_case_sweep_case, NULL, 0, &varied);
   REFUSED(CAMROLLER_USAGE, "'out'", camroller_case_sweep_case, self, 0, NULL);
   CHECK(varied == NULL && camroller_case_sweep_case(copy, 8, &varied, &error) == 0);
   CHECK(camroller_case_sweep_size(varied) == 1);
   REFUSED(CAMROLLER_USAGE, "key", camroller_case_sweep_value, varied, 0, 0, few, 10);
   count = 0;
   for (size_t i = 0; camroller_case_number(varied, i, texts, sizeof unit, &value, &error) == 0; i++) {
      if (strcmp(name, "roller.mass_kg") == 0) CHECK(value == 0.5 && ++count);
      if (strcmp(name, "operating_point.speed_rpm") == 0) CHECK(value == 900.0 && ++count);
   }
   CHECK(count == 2);
   camroller_case_free(copy);
   camroller_case_free(varied);
}

/* Steps of a shaft that anyone who has it makes the same */
static void turn(camroller_shaft *self, double *sum) {
   camroller_inputs start = inputs(30.0), end = inputs(31.0);
   camroller_shaft_outcome outcome = {.size = sizeof outcome};
   double from = camroller_shaft_angle(self);
   *sum = 0.0;
   for (int i = 1; i <= 30; i++) {
      CHECK(camroller_shaft_step(self, from + 0.1 * i, &start, &end, NULL, &outcome, &error) == 0);
      *sum += outcome.mean_torque_drive + outcome.torque_friction + outcome.mean_torque_bearings;
   }
}

static void test_shaft(const char *path, const camroller_case *other) {
   camroller_case *self = NULL;
   camroller_shaft *shaft = NULL, *copy = NULL, *restored = NULL, *hot = NULL;
   camroller_inputs start = inputs(30.0), end = inputs(31.0), wrong = inputs(-1.0);
   camroller_shaft_outcome outcome = {.size = sizeof outcome}, small = {.size = 8};
   camroller_outcome follower = {.size = sizeof follower};
   camroller_cam cam = {.size = sizeof cam}, small_cam = {.size = 1};
   char name[64], unit[64], meaning[64], *texts[3] = {name, unit, meaning}, *nothing[3] = {NULL, NULL, NULL};
   double value, kept, sums[3], values[100], pressures[6] = {1e5, 2e5, 3e5, 1e5, 2e5, 3e5};
   size_t bytes, count = 0;
   CHECK(camroller_case_from_file(path, &self, &error) == 0);
   REFUSED(CAMROLLER_USAGE, "'camroller_case'", camroller_shaft_new, NULL, 0.0, 1, &shaft);
   REFUSED(CAMROLLER_USAGE, "'out'", camroller_shaft_new, self, 0.0, 1, NULL);
   REFUSED(CAMROLLER_USAGE, "finite", camroller_shaft_new, self, INFINITY, 1, &shaft);
   REFUSED(CAMROLLER_USAGE, "threads", camroller_shaft_new, self, 0.0, 0, &shaft);
   CHECK(shaft == NULL && camroller_shaft_cams(NULL) == 0 && camroller_shaft_angle(NULL) == 0.0);
   CHECK(camroller_shaft_new(self, 1.0, 2, &shaft, &error) == 0 && camroller_shaft_cams(shaft) == 3);
   CHECK(camroller_shaft_angle(shaft) == 1.0);
   CHECK(camroller_shaft_cam(shaft, 2, &cam, &error) == 0 && cam.lobe == 2 && cam.camshaft == 1);
   CHECK(fabs(cam.phase - turn_angle / 3.0) < 1e-12);
   REFUSED(CAMROLLER_USAGE, "cam 4", camroller_shaft_cam, shaft, 4, &cam);
   REFUSED(CAMROLLER_USAGE, "cam 0", camroller_shaft_cam, shaft, 0, &cam);
   REFUSED(CAMROLLER_USAGE, "size", camroller_shaft_cam, shaft, 1, &small_cam);
   REFUSED(CAMROLLER_USAGE, "NULL", camroller_shaft_cam, NULL, 1, &cam);
   REFUSED(CAMROLLER_USAGE, "'facts'", camroller_shaft_cam, shaft, 1, NULL);
   REFUSED(CAMROLLER_USAGE, "no step", camroller_shaft_value, shaft, 1, "contact_load", &value);
   REFUSED(CAMROLLER_USAGE, "no step", camroller_shaft_values, shaft, 0, values, 100);
   REFUSED(CAMROLLER_USAGE, "no step", camroller_shaft_follower, shaft, 1, &follower);
   CHECK(camroller_shaft_step(shaft, 1.1, &start, &end, NULL, &outcome, &error) == 0);
   CHECK(outcome.mean_torque_bearings > 0.0 && outcome.mean_torque_friction > outcome.mean_torque_bearings);
   CHECK(outcome.extreme_torque[0] <= outcome.torque_drive && outcome.torque_drive <= outcome.extreme_torque[1]);
   CHECK(outcome.estimated_error > 0.0 && outcome.estimated_error < 1e-2 * outcome.mean_torque_friction);
   CHECK(camroller_shaft_step(shaft, 1.2, &start, &end, pressures, NULL, NULL) == 0);
   CHECK(camroller_shaft_follower(shaft, 3, &follower, &error) == 0 && follower.contact_load[1] > 0.0);
   CHECK(camroller_shaft_value(shaft, 3, "contact_load", &value, &error) == 0);
   CHECK(follower.contact_load[0] <= value && value <= follower.contact_load[1]);
   CHECK(camroller_shaft_value(shaft, 3, "torque_contact", &value, &error) == 0 && value == follower.torques[1] && value > 0.0);
   REFUSED(CAMROLLER_USAGE, "torque_bearings", camroller_shaft_value, shaft, 3, "torque_bearings", &value);
   follower.size = 3;
   REFUSED(CAMROLLER_USAGE, "size", camroller_shaft_follower, shaft, 3, &follower);
   REFUSED(CAMROLLER_USAGE, "cam 9", camroller_shaft_follower, shaft, 9, &follower);
   REFUSED(CAMROLLER_USAGE, "NULL", camroller_shaft_follower, NULL, 1, &follower);
   REFUSED(CAMROLLER_USAGE, "'outcome'", camroller_shaft_follower, shaft, 1, NULL);
   count = 0;
   for (size_t i = 0; camroller_shaft_remark(shaft, i, texts, sizeof name, NULL) == 0; i++)
      if (strcmp(name, "oil far from its points") == 0) count++;
   CHECK(count == 0);
   CHECK(camroller_shaft_copy(shaft, &hot, &error) == 0);
   start.oil_temperature = end.oil_temperature = 440.0;
   CHECK(camroller_shaft_step(hot, 1.21, &start, &end, NULL, NULL, &error) == 0);
   start.oil_temperature = end.oil_temperature = wrong.oil_temperature;
   for (size_t i = 0; camroller_shaft_remark(hot, i, texts, sizeof name, &error) == 0; i++)
      if (strcmp(name, "oil far from its points") == 0 && strstr(unit, "oil temperature, 166.85") != NULL) count++;
   CHECK(count == 1 && error.code == CAMROLLER_USAGE);
   CHECK(camroller_shaft_remark(hot, 0, NULL, 0, &error) == 0);
   CHECK(camroller_shaft_remark(hot, 0, nothing, 0, &error) == 0);
   camroller_shaft_free(hot);
   REFUSED(CAMROLLER_USAGE, "number", camroller_shaft_remark, shaft, SIZE_MAX, texts, 10);
   REFUSED(CAMROLLER_USAGE, "NULL", camroller_shaft_remark, NULL, 0, texts, 10);
   for (int which = 0; which <= 3; which += 3) {
      CHECK(camroller_shaft_values(shaft, which, values, 100, &error) == 0);
      for (count = 0; camroller_shaft_quantity(shaft, which, count, texts, sizeof name, NULL) == 0; count++)
         CHECK(camroller_shaft_value(shaft, which, name, &value, &error) == 0 && value == values[count]);
      CHECK(count > 3);
      REFUSED(CAMROLLER_USAGE, "room", camroller_shaft_values, shaft, which, values, count - 1);
   }
   CHECK(camroller_shaft_quantity(shaft, 0, 0, nothing, 0, &error) == 0);
   CHECK(camroller_shaft_quantity(shaft, 0, 0, NULL, 0, &error) == 0);
   REFUSED(CAMROLLER_USAGE, "number", camroller_shaft_quantity, shaft, 1, SIZE_MAX, texts, 10);
   REFUSED(CAMROLLER_USAGE, "cam 9", camroller_shaft_quantity, shaft, 9, 0, texts, 10);
   REFUSED(CAMROLLER_USAGE, "NULL", camroller_shaft_quantity, NULL, 0, 0, texts, 10);
   REFUSED(CAMROLLER_USAGE, "NULL", camroller_shaft_values, NULL, 0, values, 100);
   REFUSED(CAMROLLER_USAGE, "'values'", camroller_shaft_values, shaft, 0, NULL, 100);
   REFUSED(CAMROLLER_USAGE, "cam -1", camroller_shaft_values, shaft, -1, values, 100);
   REFUSED(CAMROLLER_USAGE, "contact_load", camroller_shaft_value, shaft, 0, "contact_load", &value);
   REFUSED(CAMROLLER_USAGE, "cam 7", camroller_shaft_value, shaft, 7, "contact_load", &value);
   REFUSED(CAMROLLER_USAGE, "NULL", camroller_shaft_value, NULL, 1, "a", &value);
   REFUSED(CAMROLLER_USAGE, "'name'", camroller_shaft_value, shaft, 1, NULL, &value);
   REFUSED(CAMROLLER_USAGE, "'value'", camroller_shaft_value, shaft, 1, "a", NULL);

   REFUSED(CAMROLLER_USAGE, "grow", camroller_shaft_step, shaft, 1.2, &start, &end, NULL, &outcome);
   REFUSED(CAMROLLER_USAGE, "backward", camroller_shaft_step, shaft, 1.0, &start, &end, NULL, &outcome);
   REFUSED(CAMROLLER_USAGE, "cam 1: advance: the speed", camroller_shaft_step, shaft, 1.3, &wrong, &end, NULL, &outcome);
   wrong.size = 1;
   REFUSED(CAMROLLER_USAGE, "size", camroller_shaft_step, shaft, 1.3, &wrong, &end, NULL, &outcome);
   REFUSED(CAMROLLER_USAGE, "size", camroller_shaft_step, shaft, 1.3, &start, &end, NULL, &small);
   REFUSED(CAMROLLER_USAGE, "NULL", camroller_shaft_step, NULL, 1.3, &start, &end, NULL, &outcome);
   REFUSED(CAMROLLER_USAGE, "'start'", camroller_shaft_step, shaft, 1.3, NULL, &end, NULL, &outcome);
   REFUSED(CAMROLLER_USAGE, "'finish'", camroller_shaft_step, shaft, 1.3, &start, NULL, NULL, &outcome);
   pressures[4] = INFINITY;
   REFUSED(CAMROLLER_USAGE, "cam 2", camroller_shaft_step, shaft, 1.3, &start, &end, pressures, &outcome);
   CHECK(camroller_shaft_angle(shaft) == 1.2);
   /* calls that fail leave the numbers of the last step */
   CHECK(camroller_shaft_value(shaft, 3, name, &kept, &error) == 0 && kept == value);

   bytes = camroller_shaft_save_size(shaft);
   CHECK(camroller_shaft_save_size(NULL) == 0);
   char *block = malloc(bytes);
   CHECK(camroller_shaft_save(shaft, block, bytes, &error) == 0);
   REFUSED(CAMROLLER_USAGE, "small", camroller_shaft_save, shaft, block, bytes - 1);
   REFUSED(CAMROLLER_USAGE, "NULL", camroller_shaft_save, NULL, block, bytes);
   REFUSED(CAMROLLER_USAGE, "'buffer'", camroller_shaft_save, shaft, NULL, bytes);
   /* what cannot be made leaves NULL, not what was there */
   copy = (camroller_shaft *)block;
   REFUSED(CAMROLLER_USAGE, "NULL", camroller_shaft_copy, NULL, &copy);
   CHECK(copy == NULL);
   CHECK(camroller_shaft_copy(shaft, &copy, &error) == 0);
   REFUSED(CAMROLLER_USAGE, "'out'", camroller_shaft_copy, shaft, NULL);
   REFUSED(CAMROLLER_USAGE, "size", camroller_shaft_restore, self, block, bytes - 1, 1, &restored);
   REFUSED(CAMROLLER_USAGE, "damaged", camroller_shaft_restore, self, block, bytes - 8, 1, &restored);
   REFUSED(CAMROLLER_USAGE, "size", camroller_shaft_restore, self, block, 8, 1, &restored);
   REFUSED(CAMROLLER_USAGE, "another case", camroller_shaft_restore, other, block, bytes, 1, &restored);
   REFUSED(CAMROLLER_USAGE, "threads", camroller_shaft_restore, self, block, bytes, 0, &restored);
   REFUSED(CAMROLLER_USAGE, "NULL", camroller_shaft_restore, NULL, block, bytes, 1, &restored);
   REFUSED(CAMROLLER_USAGE, "'buffer'", camroller_shaft_restore, self, NULL, bytes, 1, &restored);
   REFUSED(CAMROLLER_USAGE, "'out'", camroller_shaft_restore, self, block, bytes, 1, NULL);
   CHECK(restored == NULL && camroller_shaft_restore(self, block, bytes, 1, &restored, &error) == 0);
   turn(shaft, &sums[0]);
   turn(copy, &sums[1]);
   turn(restored, &sums[2]);
   CHECK(sums[0] == sums[1] && sums[0] == sums[2]);
   CHECK(camroller_shaft_halt(copy, &error) == 0);
   REFUSED(CAMROLLER_USAGE, "NULL", camroller_shaft_halt, NULL);
   turn(copy, &sums[1]);
   turn(shaft, &sums[0]);
   CHECK(sums[0] != sums[1]);
   camroller_shaft_free(shaft);
   camroller_shaft_free(copy);
   camroller_shaft_free(restored);
   camroller_shaft_free(NULL);
   camroller_case_free(self);
   free(block);
}

/* A law outside its range where that is forbidden; a method that gets nowhere at such a speed, after which the follower goes on */
static void test_other_kinds(const camroller_case *self) {
   camroller_case *own = NULL;
   camroller_result *result = NULL;
   camroller_simulation *simulation = NULL;
   camroller_inputs start = inputs(30.0), fast = inputs(1e10), cold = inputs(60.0);
   double velocity, again;
   CHECK(camroller_case_copy(self, &own, &error) == 0);
   CHECK(camroller_case_set(own, "film.range_policy", "'stop'", &error) == 0);
   REFUSED(CAMROLLER_DOMAIN, "published range", camroller_case_run, own, &result);
   CHECK(result == NULL);
   CHECK(camroller_simulation_new(own, 1, 3.0, &simulation, &error) == 0);
   REFUSED(CAMROLLER_DOMAIN, "published range", camroller_simulation_step, simulation, 6.0, &start, &start, NULL);
   CHECK(camroller_simulation_angle(simulation) == 3.0);
   camroller_simulation_free(simulation);
   CHECK(camroller_case_set(own, "film.range_policy", "'warn'", &error) == 0);
   CHECK(camroller_case_set(own, "numerics.method", "'dormand_prince'", &error) == 0);
   CHECK(camroller_simulation_new(own, 1, 1.0, &simulation, &error) == 0);
   CHECK(camroller_simulation_step(simulation, 4.0, &fast, &fast, NULL, &error) == CAMROLLER_CONVERGENCE);
   CHECK(error.code == CAMROLLER_CONVERGENCE && strstr(error.message, "deg") != NULL);
   CHECK(camroller_simulation_angle(simulation) == 1.0);
   CHECK(camroller_simulation_step(simulation, 1.01, &start, &start, NULL, &error) == 0);
   camroller_simulation_free(simulation);
   /* the model has followed speed and oil of a step that fails, and is put back */
   CHECK(camroller_case_set(own, "numerics.method", "'automatic'", &error) == 0);
   CHECK(camroller_simulation_new(own, 1, 1.0, &simulation, &error) == 0);
   CHECK(camroller_simulation_step(simulation, 2.8, &start, &start, NULL, &error) == 0);
   CHECK(camroller_simulation_value(simulation, "valve_velocity", &velocity, &error) == 0 && velocity != 0.0);
   cold.oil_temperature = 50.0;
   CHECK(camroller_simulation_step(simulation, 2.8001, &start, &cold, NULL, &error) != 0);
   CHECK(camroller_simulation_value(simulation, "valve_velocity", &again, &error) == 0 && again == velocity);
   camroller_simulation_free(simulation);
   camroller_case_free(own);
}

/* A block of another case is refused */
static void test_other_case(camroller_case *self) {
   camroller_simulation *simulation = NULL, *restored = NULL;
   size_t bytes = camroller_simulation_save_size();
   char *block = malloc(bytes);
   CHECK(camroller_simulation_new(self, 1, 0.0, &simulation, &error) == 0);
   CHECK(camroller_simulation_save(simulation, block, bytes, &error) == 0);
   CHECK(camroller_case_set(self, "roller.mass_kg", "0.01", &error) == 0);
   REFUSED(CAMROLLER_USAGE, "another case", camroller_simulation_restore, self, block, bytes, &restored);
   camroller_simulation_free(simulation);
   free(block);
}

/* Save in one process, restore in another */
static int keep_or_restore(const camroller_case *self, const char *path) {
   camroller_simulation *simulation = NULL;
   double sum;
   size_t bytes = camroller_simulation_save_size();
   char *block = malloc(bytes);
   FILE *file = fopen(path, "rb");
   if (file == NULL) {
      CHECK(camroller_simulation_new(self, 1, 0.3, &simulation, &error) == 0);
      drive(simulation, &sum);
      CHECK(camroller_simulation_save(simulation, block, bytes, &error) == 0);
      file = fopen(path, "wb");
      CHECK(fwrite(block, 1, bytes, file) == bytes);
   } else {
      CHECK(fread(block, 1, bytes, file) == bytes);
      CHECK(camroller_simulation_restore(self, block, bytes, &simulation, &error) == 0);
   }
   fclose(file);
   drive(simulation, &sum);
   printf("%a\n", sum);
   camroller_simulation_free(simulation);
   free(block);
   return failures > 0;
}

int main(int count, char **words) {
   camroller_case *self = NULL;
   static char before[1 << 20], after[1 << 20];
   if (count < 3) return 9;
   if (count > 3) {
      CHECK(camroller_case_from_file(words[1], &self, &error) == 0);
      int code = keep_or_restore(self, words[3]);
      camroller_case_free(self);
      return code;
   }
   note_settings(before);
   test_version();
   self = test_case(words[1]);
   test_result(self);
   test_simulation(self);
   test_deck(self);
   test_other_kinds(self);
   test_shaft(words[2], self);
   test_other_case(self);
   camroller_case_free(self);
   note_settings(after);
   CHECK(strcmp(before, after) == 0);
   printf("%d failures\n", failures);
   return failures > 0;
}
