/* Every call of the C interface, with right arguments, with NULL and with what must be refused. Ends with 0 where all is right.
 *
 * Usage: interface DECK CAMSHAFT          decks with one cam, and with three
 *        interface DECK --restore BLOCK   a follower is restored from that file, or saved there, and stepped; its numbers are printed */
#include <camroller.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int failures = 0;

#define CHECK(condition) \
   do { \
      if (!(condition)) { \
         failures++; \
         fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #condition); \
      } \
   } while (0)

/* A call is refused with a code and a message that names a word */
#define REFUSED(call, kind, word) \
   do { \
      error.message[0] = 0; \
      CHECK((call) == (kind)); \
      CHECK(error.code == (kind)); \
      CHECK(strstr(error.message, word) != NULL); \
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
}

static camroller_case *test_case(const char *path) {
   camroller_case *from_file = NULL, *from_text = NULL, *none = NULL;
   char *text = read_all(path);
   CHECK(camroller_case_from_file(path, &from_file, &error) == 0 && from_file != NULL);
   CHECK(camroller_case_from_text(text, "decks", &from_text, NULL) == 0 && from_text != NULL);
   REFUSED(camroller_case_from_file("no such deck", &none, &error), CAMROLLER_FILE, "no such deck");
   REFUSED(camroller_case_from_file(NULL, &none, &error), CAMROLLER_USAGE, "'path'");
   REFUSED(camroller_case_from_file(path, NULL, &error), CAMROLLER_USAGE, "'out'");
   REFUSED(camroller_case_from_text(NULL, NULL, &none, &error), CAMROLLER_USAGE, "'text'");
   REFUSED(camroller_case_from_text("", NULL, NULL, &error), CAMROLLER_USAGE, "'out'");
   REFUSED(camroller_case_from_text("&lift law = 3 /", NULL, &none, &error), CAMROLLER_DECK, "text:1:");
   CHECK(none == NULL);
   CHECK(camroller_case_from_text("&lift law = 3 /", NULL, &none, NULL) == CAMROLLER_DECK);
   camroller_error old = {sizeof(size_t), 77, 0, ""};
   CHECK(camroller_case_from_text("&lift law = 3 /", NULL, &none, &old) == CAMROLLER_DECK && old.code == 77);
   CHECK(camroller_case_set(from_text, "operating_point.speed_rpm", "900", &error) == 0);
   REFUSED(camroller_case_set(from_text, "operating_point.speed", "900", &error), CAMROLLER_DECK, "speed_rpm");
   REFUSED(camroller_case_set(NULL, "a.b", "1", &error), CAMROLLER_USAGE, "'camroller_case'");
   REFUSED(camroller_case_set(from_text, NULL, "1", &error), CAMROLLER_USAGE, "'key'");
   REFUSED(camroller_case_set(from_text, "a.b", NULL, &error), CAMROLLER_USAGE, "'value'");
   CHECK(camroller_case_check(from_text, &error) == 0);
   REFUSED(camroller_case_check(NULL, &error), CAMROLLER_USAGE, "NULL");
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
   REFUSED(camroller_case_run(NULL, &result, &error), CAMROLLER_USAGE, "'camroller_case'");
   REFUSED(camroller_case_run(self, NULL, &error), CAMROLLER_USAGE, "'out'");
   CHECK(camroller_case_run(self, &result, &error) == 0 && error.code == 0 && error.message[0] == 0);
   CHECK(camroller_result_scalar(result, "mean_torque_friction", &torque, &error) == 0 && torque > 0.0);
   REFUSED(camroller_result_scalar(result, "no_such", &torque, &error), CAMROLLER_USAGE, "no_such");
   CHECK(torque > 0.0); /* a call that is refused leaves what it would have filled */
   REFUSED(camroller_result_scalar(NULL, "a", &torque, &error), CAMROLLER_USAGE, "NULL");
   REFUSED(camroller_result_scalar(result, NULL, &torque, &error), CAMROLLER_USAGE, "'name'");
   REFUSED(camroller_result_scalar(result, "a", NULL, &error), CAMROLLER_USAGE, "'value'");
   rows = camroller_result_rows(result);
   CHECK(rows > 100 && camroller_result_rows(NULL) == 0);
   angle = malloc(rows * sizeof *angle);
   friction = malloc(rows * sizeof *friction);
   CHECK(camroller_result_series(result, "cam_angle", angle, rows, &error) == 0);
   CHECK(angle[0] == 0.0 && fabs(angle[rows - 1] - turn_angle) < 0.1);
   CHECK(camroller_result_series(result, "torque_friction", friction, rows, &error) == 0);
   for (size_t i = 0; i < rows; i++) sum += friction[i] / rows;
   CHECK(fabs(sum - torque) < 0.1 * torque);
   REFUSED(camroller_result_series(result, "torque_friction", friction, rows - 1, &error), CAMROLLER_USAGE, "room");
   REFUSED(camroller_result_series(result, "no_such", friction, rows, &error), CAMROLLER_USAGE, "no_such");
   REFUSED(camroller_result_series(NULL, "a", friction, rows, &error), CAMROLLER_USAGE, "NULL");
   REFUSED(camroller_result_series(result, NULL, friction, rows, &error), CAMROLLER_USAGE, "'name'");
   REFUSED(camroller_result_series(result, "a", NULL, rows, &error), CAMROLLER_USAGE, "'values'");
   CHECK(camroller_result_unit(result, "torque_friction", unit, sizeof unit, &error) == 0 && strcmp(unit, "N m") == 0);
   CHECK(camroller_result_unit(result, "cam_angle", unit, sizeof unit, &error) == 0 && strcmp(unit, "rad") == 0);
   CHECK(camroller_result_unit(result, "mean_torque_friction", unit, sizeof unit, &error) == 0);
   REFUSED(camroller_result_unit(result, "no_such", unit, sizeof unit, &error), CAMROLLER_USAGE, "no_such");
   REFUSED(camroller_result_unit(NULL, "a", unit, sizeof unit, &error), CAMROLLER_USAGE, "NULL");
   REFUSED(camroller_result_unit(result, NULL, unit, sizeof unit, &error), CAMROLLER_USAGE, "'name'");
   REFUSED(camroller_result_unit(result, "a", NULL, 0, &error), CAMROLLER_USAGE, "'buffer'");
   for (int kind = 0; kind < 2; kind++)
      for (size_t i = 0; camroller_result_quantity(result, kind, i, texts, sizeof unit, NULL) == 0; i++) count++;
   CHECK(count > 50);
   CHECK(camroller_result_quantity(result, 0, 0, nothing, 0, &error) == 0);
   REFUSED(camroller_result_quantity(result, 2, 0, texts, 10, &error), CAMROLLER_USAGE, "number");
   REFUSED(camroller_result_quantity(NULL, 0, 0, texts, 10, &error), CAMROLLER_USAGE, "NULL");
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
   double value, sums[3];
   size_t bytes = camroller_simulation_save_size();
   char *block = malloc(bytes);
   REFUSED(camroller_simulation_new(NULL, 1, 0.0, &simulation, &error), CAMROLLER_USAGE, "'camroller_case'");
   REFUSED(camroller_simulation_new(self, 1, 0.0, NULL, &error), CAMROLLER_USAGE, "'out'");
   REFUSED(camroller_simulation_new(self, 2, 0.0, &simulation, &error), CAMROLLER_USAGE, "second_lift");
   REFUSED(camroller_simulation_new(self, 1, INFINITY, &simulation, &error), CAMROLLER_USAGE, "finite");
   CHECK(simulation == NULL);
   CHECK(camroller_simulation_new(self, 1, 1.0, &simulation, &error) == 0 && simulation != NULL);
   CHECK(camroller_simulation_angle(simulation) == 1.0 && camroller_simulation_angle(NULL) == 0.0);
   REFUSED(camroller_simulation_value(simulation, "contact_load", &value, &error), CAMROLLER_USAGE, "no step");
   CHECK(camroller_simulation_step(simulation, 1.1, &start, &end, &outcome, &error) == 0);
   CHECK(outcome.mean_torque_friction > 0.0 && outcome.contact_load[0] <= outcome.contact_load[1]);
   CHECK(fabs(outcome.torques[0] + outcome.torques[1] + outcome.torques[2] + outcome.torques[3] + outcome.torques[4]
              - outcome.torque_drive) < 1e-12);
   CHECK(camroller_simulation_value(simulation, "contact_load", &value, &error) == 0);
   CHECK(value > 0.0 && fabs(hypot(outcome.cam_force[0], outcome.cam_force[1]) / value - 1.0) < 0.1);
   CHECK(camroller_simulation_step(simulation, 1.2, &start, &end, NULL, NULL) == 0);
   REFUSED(camroller_simulation_step(simulation, 1.2, &start, &end, &outcome, &error), CAMROLLER_USAGE, "grow");
   REFUSED(camroller_simulation_step(simulation, 1.3, &wrong, &end, &outcome, &error), CAMROLLER_USAGE, "speed");
   wrong.size = 1;
   REFUSED(camroller_simulation_step(simulation, 1.3, &wrong, &end, &outcome, &error), CAMROLLER_USAGE, "size");
   REFUSED(camroller_simulation_step(simulation, 1.3, &start, &end, &small, &error), CAMROLLER_USAGE, "size");
   REFUSED(camroller_simulation_step(NULL, 1.3, &start, &end, &outcome, &error), CAMROLLER_USAGE, "NULL");
   REFUSED(camroller_simulation_step(simulation, 1.3, NULL, &end, &outcome, &error), CAMROLLER_USAGE, "'start'");
   REFUSED(camroller_simulation_step(simulation, 1.3, &start, NULL, &outcome, &error), CAMROLLER_USAGE, "'finish'");
   pressed.has_pressure = 1;
   REFUSED(camroller_simulation_step(simulation, 1.3, &pressed, &pressed, &outcome, &error), CAMROLLER_USAGE, "&gas_force");
   REFUSED(camroller_simulation_value(simulation, "no_such", &value, &error), CAMROLLER_USAGE, "no_such");
   REFUSED(camroller_simulation_value(NULL, "a", &value, &error), CAMROLLER_USAGE, "NULL");
   REFUSED(camroller_simulation_value(simulation, NULL, &value, &error), CAMROLLER_USAGE, "'name'");
   REFUSED(camroller_simulation_value(simulation, "a", NULL, &error), CAMROLLER_USAGE, "'value'");

   CHECK(camroller_simulation_save(simulation, block, bytes, &error) == 0);
   REFUSED(camroller_simulation_save(simulation, block, bytes - 1, &error), CAMROLLER_USAGE, "small");
   REFUSED(camroller_simulation_save(NULL, block, bytes, &error), CAMROLLER_USAGE, "NULL");
   REFUSED(camroller_simulation_save(simulation, NULL, bytes, &error), CAMROLLER_USAGE, "'buffer'");
   CHECK(camroller_simulation_copy(simulation, &copy, &error) == 0);
   REFUSED(camroller_simulation_copy(NULL, &copy, &error), CAMROLLER_USAGE, "NULL");
   REFUSED(camroller_simulation_copy(simulation, NULL, &error), CAMROLLER_USAGE, "'out'");
   REFUSED(camroller_simulation_restore(self, block, bytes - 1, &restored, &error), CAMROLLER_USAGE, "size");
   block[50] ^= 1;
   REFUSED(camroller_simulation_restore(self, block, bytes, &restored, &error), CAMROLLER_USAGE, "damaged");
   block[50] ^= 1;
   block[0] ^= 1;
   REFUSED(camroller_simulation_restore(self, block, bytes, &restored, &error), CAMROLLER_USAGE, "not one");
   block[0] ^= 1;
   REFUSED(camroller_simulation_restore(NULL, block, bytes, &restored, &error), CAMROLLER_USAGE, "NULL");
   REFUSED(camroller_simulation_restore(self, NULL, bytes, &restored, &error), CAMROLLER_USAGE, "'buffer'");
   REFUSED(camroller_simulation_restore(self, block, bytes, NULL, &error), CAMROLLER_USAGE, "'out'");
   CHECK(restored == NULL);
   CHECK(camroller_simulation_restore(self, block, bytes, &restored, &error) == 0);
   drive(simulation, &sums[0]);
   drive(copy, &sums[1]);
   drive(restored, &sums[2]);
   CHECK(sums[0] == sums[1] && sums[0] == sums[2]);
   CHECK(camroller_simulation_halt(copy, &error) == 0);
   REFUSED(camroller_simulation_halt(NULL, &error), CAMROLLER_USAGE, "NULL");
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
   double value = 0.0;
   size_t count = 0, cases;
   REFUSED(camroller_case_copy(NULL, &copy, &error), CAMROLLER_USAGE, "NULL");
   REFUSED(camroller_case_copy(self, NULL, &error), CAMROLLER_USAGE, "'out'");
   CHECK(camroller_case_copy(self, &copy, &error) == 0);
   CHECK(camroller_case_set(copy, "roller.mass_kg", "0.5", &error) == 0);
   for (size_t i = 0; camroller_case_number(self, i, texts, sizeof unit, &value, &error) == 0; i++) {
      if (strcmp(name, "roller.mass_kg") == 0) CHECK(value > 0.0 && value < 0.5 && strcmp(unit, "kg") == 0);
      count++;
   }
   CHECK(count > 10 && error.code == CAMROLLER_USAGE);
   for (size_t i = 0; camroller_case_number(copy, i, texts, sizeof unit, &value, &error) == 0; i++)
      if (strcmp(name, "roller.mass_kg") == 0) CHECK(value == 0.5);
   CHECK(camroller_case_number(self, 0, nothing, 0, NULL, NULL) == 0);
   REFUSED(camroller_case_number(NULL, 0, texts, 10, &value, &error), CAMROLLER_USAGE, "NULL");
   cases = camroller_case_sweep_size(self);
   CHECK(cases == 9 && camroller_case_sweep_size(NULL) == 0);
   CHECK(camroller_case_sweep_value(self, 8, 0, few, sizeof unit, &error) == 0 && strcmp(unit, "900") == 0);
   CHECK(strcmp(name, "operating_point.speed_rpm") == 0);
   CHECK(camroller_case_sweep_value(self, 8, 0, nothing, 0, &error) == 0);
   REFUSED(camroller_case_sweep_value(self, 9, 0, few, 10, &error), CAMROLLER_USAGE, "case");
   REFUSED(camroller_case_sweep_value(self, 0, 2, few, 10, &error), CAMROLLER_USAGE, "key");
   REFUSED(camroller_case_sweep_value(NULL, 0, 0, few, 10, &error), CAMROLLER_USAGE, "NULL");
   REFUSED(camroller_case_sweep_case(self, 9, &varied, &error), CAMROLLER_USAGE, "case");
   REFUSED(camroller_case_sweep_case(NULL, 0, &varied, &error), CAMROLLER_USAGE, "NULL");
   REFUSED(camroller_case_sweep_case(self, 0, NULL, &error), CAMROLLER_USAGE, "'out'");
   CHECK(varied == NULL && camroller_case_sweep_case(copy, 8, &varied, &error) == 0);
   CHECK(camroller_case_sweep_size(varied) == 1);
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
   camroller_shaft *shaft = NULL, *copy = NULL, *restored = NULL;
   camroller_inputs start = inputs(30.0), end = inputs(31.0), wrong = inputs(-1.0);
   camroller_shaft_outcome outcome = {.size = sizeof outcome}, small = {.size = 8};
   camroller_outcome follower = {.size = sizeof follower};
   camroller_cam cam = {.size = sizeof cam}, small_cam = {.size = 1};
   char name[64], unit[64], meaning[64], *texts[3] = {name, unit, meaning}, *nothing[3] = {NULL, NULL, NULL};
   double value, sums[3], values[100], pressures[6] = {1e5, 2e5, 3e5, 1e5, 2e5, 3e5};
   size_t bytes, count = 0;
   CHECK(camroller_case_from_file(path, &self, &error) == 0);
   REFUSED(camroller_shaft_new(NULL, 0.0, 1, &shaft, &error), CAMROLLER_USAGE, "'camroller_case'");
   REFUSED(camroller_shaft_new(self, 0.0, 1, NULL, &error), CAMROLLER_USAGE, "'out'");
   REFUSED(camroller_shaft_new(self, INFINITY, 1, &shaft, &error), CAMROLLER_USAGE, "finite");
   REFUSED(camroller_shaft_new(self, 0.0, 0, &shaft, &error), CAMROLLER_USAGE, "threads");
   CHECK(shaft == NULL && camroller_shaft_cams(NULL) == 0 && camroller_shaft_angle(NULL) == 0.0);
   CHECK(camroller_shaft_new(self, 1.0, 2, &shaft, &error) == 0 && camroller_shaft_cams(shaft) == 3);
   CHECK(camroller_shaft_angle(shaft) == 1.0);
   CHECK(camroller_shaft_cam(shaft, 2, &cam, &error) == 0 && cam.lobe == 2 && cam.camshaft == 1);
   CHECK(fabs(cam.phase - turn_angle / 3.0) < 1e-12);
   REFUSED(camroller_shaft_cam(shaft, 4, &cam, &error), CAMROLLER_USAGE, "cam 4");
   REFUSED(camroller_shaft_cam(shaft, 0, &cam, &error), CAMROLLER_USAGE, "cam 0");
   REFUSED(camroller_shaft_cam(shaft, 1, &small_cam, &error), CAMROLLER_USAGE, "size");
   REFUSED(camroller_shaft_cam(NULL, 1, &cam, &error), CAMROLLER_USAGE, "NULL");
   REFUSED(camroller_shaft_cam(shaft, 1, NULL, &error), CAMROLLER_USAGE, "'facts'");
   REFUSED(camroller_shaft_value(shaft, 1, "contact_load", &value, &error), CAMROLLER_USAGE, "no step");
   REFUSED(camroller_shaft_values(shaft, 0, values, 100, &error), CAMROLLER_USAGE, "no step");
   REFUSED(camroller_shaft_follower(shaft, 1, &follower, &error), CAMROLLER_USAGE, "no step");
   CHECK(camroller_shaft_step(shaft, 1.1, &start, &end, NULL, &outcome, &error) == 0);
   CHECK(outcome.mean_torque_bearings > 0.0 && outcome.mean_torque_friction > outcome.mean_torque_bearings);
   CHECK(outcome.extreme_torque[0] <= outcome.torque_drive && outcome.torque_drive <= outcome.extreme_torque[1]);
   CHECK(outcome.estimated_error > 0.0 && outcome.estimated_error < 1e-2 * outcome.mean_torque_friction);
   CHECK(camroller_shaft_step(shaft, 1.2, &start, &end, pressures, NULL, NULL) == 0);
   CHECK(camroller_shaft_follower(shaft, 3, &follower, &error) == 0 && follower.contact_load[1] > 0.0);
   CHECK(camroller_shaft_value(shaft, 3, "contact_load", &value, &error) == 0);
   CHECK(follower.contact_load[0] <= value && value <= follower.contact_load[1]);
   follower.size = 3;
   REFUSED(camroller_shaft_follower(shaft, 3, &follower, &error), CAMROLLER_USAGE, "size");
   REFUSED(camroller_shaft_follower(shaft, 9, &follower, &error), CAMROLLER_USAGE, "cam 9");
   REFUSED(camroller_shaft_follower(NULL, 1, &follower, &error), CAMROLLER_USAGE, "NULL");
   REFUSED(camroller_shaft_follower(shaft, 1, NULL, &error), CAMROLLER_USAGE, "'outcome'");
   for (int which = 0; which <= 3; which += 3) {
      CHECK(camroller_shaft_values(shaft, which, values, 100, &error) == 0);
      for (count = 0; camroller_shaft_quantity(shaft, which, count, texts, sizeof name, NULL) == 0; count++)
         CHECK(camroller_shaft_value(shaft, which, name, &value, &error) == 0 && value == values[count]);
      CHECK(count > 3);
      REFUSED(camroller_shaft_values(shaft, which, values, count - 1, &error), CAMROLLER_USAGE, "room");
   }
   CHECK(camroller_shaft_quantity(shaft, 0, 0, nothing, 0, &error) == 0);
   REFUSED(camroller_shaft_quantity(shaft, 9, 0, texts, 10, &error), CAMROLLER_USAGE, "cam 9");
   REFUSED(camroller_shaft_quantity(NULL, 0, 0, texts, 10, &error), CAMROLLER_USAGE, "NULL");
   REFUSED(camroller_shaft_values(NULL, 0, values, 100, &error), CAMROLLER_USAGE, "NULL");
   REFUSED(camroller_shaft_values(shaft, 0, NULL, 100, &error), CAMROLLER_USAGE, "'values'");
   REFUSED(camroller_shaft_values(shaft, -1, values, 100, &error), CAMROLLER_USAGE, "cam -1");
   REFUSED(camroller_shaft_value(shaft, 0, "contact_load", &value, &error), CAMROLLER_USAGE, "contact_load");
   REFUSED(camroller_shaft_value(shaft, 7, "contact_load", &value, &error), CAMROLLER_USAGE, "cam 7");
   REFUSED(camroller_shaft_value(NULL, 1, "a", &value, &error), CAMROLLER_USAGE, "NULL");
   REFUSED(camroller_shaft_value(shaft, 1, NULL, &value, &error), CAMROLLER_USAGE, "'name'");
   REFUSED(camroller_shaft_value(shaft, 1, "a", NULL, &error), CAMROLLER_USAGE, "'value'");

   REFUSED(camroller_shaft_step(shaft, 1.2, &start, &end, NULL, &outcome, &error), CAMROLLER_USAGE, "grow");
   REFUSED(camroller_shaft_step(shaft, 1.0, &start, &end, NULL, &outcome, &error), CAMROLLER_USAGE, "backward");
   REFUSED(camroller_shaft_step(shaft, 1.3, &wrong, &end, NULL, &outcome, &error), CAMROLLER_USAGE, "cam 1: advance: the speed");
   wrong.size = 1;
   REFUSED(camroller_shaft_step(shaft, 1.3, &wrong, &end, NULL, &outcome, &error), CAMROLLER_USAGE, "size");
   REFUSED(camroller_shaft_step(shaft, 1.3, &start, &end, NULL, &small, &error), CAMROLLER_USAGE, "size");
   REFUSED(camroller_shaft_step(NULL, 1.3, &start, &end, NULL, &outcome, &error), CAMROLLER_USAGE, "NULL");
   REFUSED(camroller_shaft_step(shaft, 1.3, NULL, &end, NULL, &outcome, &error), CAMROLLER_USAGE, "'start'");
   REFUSED(camroller_shaft_step(shaft, 1.3, &start, NULL, NULL, &outcome, &error), CAMROLLER_USAGE, "'finish'");
   pressures[4] = INFINITY;
   REFUSED(camroller_shaft_step(shaft, 1.3, &start, &end, pressures, &outcome, &error), CAMROLLER_USAGE, "cam 2");
   CHECK(camroller_shaft_angle(shaft) == 1.2);

   bytes = camroller_shaft_save_size(shaft);
   CHECK(camroller_shaft_save_size(NULL) == 0);
   char *block = malloc(bytes);
   CHECK(camroller_shaft_save(shaft, block, bytes, &error) == 0);
   REFUSED(camroller_shaft_save(shaft, block, bytes - 1, &error), CAMROLLER_USAGE, "small");
   REFUSED(camroller_shaft_save(NULL, block, bytes, &error), CAMROLLER_USAGE, "NULL");
   REFUSED(camroller_shaft_save(shaft, NULL, bytes, &error), CAMROLLER_USAGE, "'buffer'");
   CHECK(camroller_shaft_copy(shaft, &copy, &error) == 0);
   REFUSED(camroller_shaft_copy(NULL, &copy, &error), CAMROLLER_USAGE, "NULL");
   REFUSED(camroller_shaft_copy(shaft, NULL, &error), CAMROLLER_USAGE, "'out'");
   REFUSED(camroller_shaft_restore(self, block, bytes - 1, 1, &restored, &error), CAMROLLER_USAGE, "size");
   REFUSED(camroller_shaft_restore(self, block, bytes - 8, 1, &restored, &error), CAMROLLER_USAGE, "damaged");
   REFUSED(camroller_shaft_restore(self, block, 8, 1, &restored, &error), CAMROLLER_USAGE, "size");
   REFUSED(camroller_shaft_restore(other, block, bytes, 1, &restored, &error), CAMROLLER_USAGE, "another case");
   REFUSED(camroller_shaft_restore(self, block, bytes, 0, &restored, &error), CAMROLLER_USAGE, "threads");
   REFUSED(camroller_shaft_restore(NULL, block, bytes, 1, &restored, &error), CAMROLLER_USAGE, "NULL");
   REFUSED(camroller_shaft_restore(self, NULL, bytes, 1, &restored, &error), CAMROLLER_USAGE, "'buffer'");
   REFUSED(camroller_shaft_restore(self, block, bytes, 1, NULL, &error), CAMROLLER_USAGE, "'out'");
   CHECK(restored == NULL && camroller_shaft_restore(self, block, bytes, 1, &restored, &error) == 0);
   turn(shaft, &sums[0]);
   turn(copy, &sums[1]);
   turn(restored, &sums[2]);
   CHECK(sums[0] == sums[1] && sums[0] == sums[2]);
   CHECK(camroller_shaft_halt(copy, &error) == 0);
   REFUSED(camroller_shaft_halt(NULL, &error), CAMROLLER_USAGE, "NULL");
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

/* A block of another case is refused */
static void test_other_case(camroller_case *self) {
   camroller_simulation *simulation = NULL, *restored = NULL;
   size_t bytes = camroller_simulation_save_size();
   char *block = malloc(bytes);
   CHECK(camroller_simulation_new(self, 1, 0.0, &simulation, &error) == 0);
   CHECK(camroller_simulation_save(simulation, block, bytes, &error) == 0);
   CHECK(camroller_case_set(self, "roller.mass_kg", "0.01", &error) == 0);
   REFUSED(camroller_simulation_restore(self, block, bytes, &restored, &error), CAMROLLER_USAGE, "another case");
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
   if (count < 3) return 9;
   if (count > 3) {
      CHECK(camroller_case_from_file(words[1], &self, &error) == 0);
      int code = keep_or_restore(self, words[3]);
      camroller_case_free(self);
      return code;
   }
   test_version();
   self = test_case(words[1]);
   test_result(self);
   test_simulation(self);
   test_deck(self);
   test_shaft(words[2], self);
   test_other_case(self);
   camroller_case_free(self);
   printf("%d failures\n", failures);
   return failures > 0;
}
