/* An engine that drives its valve trains: four cylinders, sixteen followers on two camshafts, one step for each degree of crank
 * angle. The host gives speed, oil temperature and the pressure in the cylinders; the library gives the torque that the camshafts
 * take. It does what engine_host.f90 does. Usage: engine_host DECK [CYCLES [THREADS]] */
#include <camroller.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static const double pi = 3.14159265358979323846;
static const double degree = 3.14159265358979323846 / 180.0;
enum { CAMS = 16, CAMS_OF_CYLINDER = 2, STEPS = 720 };
static const int firing_place[4] = {0, 3, 1, 2}; /* of each cylinder in the order 1, 3, 4, 2 */

static camroller_error error = {.size = sizeof error};

/* Cam angle at a crank angle [rad]; the first cam has full lift 470 degrees after the firing dead centre of cylinder 1 */
static double cam_angle(double crank) {
   return pi + 0.5 * (crank - 470.0 * degree);
}

/* Speed of the camshafts [rad/s]: 2000 rev/min of the crank with the ripple of four cylinders */
static double speed_at(double crank) {
   return 2000.0 * pi / 60.0 * (1.0 - 0.02 * cos(2.0 * crank));
}

/* Gauge pressure in a cylinder [Pa] at the crank angle after its firing dead centre [rad] */
static double cylinder_pressure(double crank) {
   double cycle = 4.0 * pi, angle = fmod(crank + 0.5 * cycle, cycle);
   if (angle < 0.0) angle += cycle;
   angle -= 0.5 * cycle;
   if (fabs(angle) >= pi) return 0.0;
   double volume = 0.1 + 0.45 * (1.0 - cos(angle)), burnt = 0.5 * (1.0 + tanh((angle - 12.0 * degree) / (10.0 * degree)));
   return 1.0e5 * (pow(volume, -1.32) * (1.0 + 1.5 * burnt * (1.0 + cos(angle))) - 1.0);
}

static void pressures_at(double crank, double *pressures) {
   for (int cam = 0; cam < CAMS; cam++)
      pressures[cam] = cylinder_pressure(crank - firing_place[cam / CAMS_OF_CYLINDER % 4] * pi);
}

static void stop_on(int code) {
   if (code == 0) return;
   fprintf(stderr, "%s\n", error.message);
   exit(1);
}

int main(int count, char **words) {
   int cycles = count > 2 ? atoi(words[2]) : 3, threads = count > 3 ? atoi(words[3]) : 1;
   camroller_case *engine;
   camroller_shaft *shaft;
   camroller_inputs ends[2] = {{.size = sizeof ends[0]}, {.size = sizeof ends[0]}};
   camroller_shaft_outcome outcome = {.size = sizeof outcome};
   double pressures[2 * CAMS];
   if (count < 2 || camroller_library_version() / 100 != CAMROLLER_VERSION / 100) return 2;
   camroller_use_one_blas_thread();
   stop_on(camroller_case_from_file(words[1], &engine, &error));
   stop_on(camroller_shaft_new(engine, cam_angle(0.0), threads, &shaft, &error));
   camroller_case_free(engine);
   if (camroller_shaft_cams(shaft) != CAMS) return 2;
   for (int cycle = 0; cycle < cycles; cycle++) {
      double torques[3] = {0.0, 0.0, 0.0};
      struct timespec begin, finish;
      timespec_get(&begin, TIME_UTC);
      for (int i = 0; i < STEPS; i++) {
         double crank[2] = {(cycle * STEPS + i) * degree, (cycle * STEPS + i + 1) * degree};
         for (int end = 0; end < 2; end++) {
            ends[end].speed = speed_at(crank[end]);
            ends[end].oil_temperature = 363.15;
            pressures_at(crank[end], pressures + end * CAMS);
         }
         stop_on(camroller_shaft_step(shaft, cam_angle(crank[1]), &ends[0], &ends[1], pressures, &outcome, &error));
         torques[0] += outcome.mean_torque_drive / STEPS;
         torques[1] += outcome.mean_torque_friction / STEPS;
         torques[2] += outcome.mean_torque_bearings / STEPS;
      }
      timespec_get(&finish, TIME_UTC);
      printf("cycle %d drive %.12e friction %.12e bearings %.12e\n", cycle + 1, torques[0], torques[1], torques[2]);
      fprintf(stderr, "cycle %d took %.3f s\n", cycle + 1,
              (double)(finish.tv_sec - begin.tv_sec) + 1e-9 * (double)(finish.tv_nsec - begin.tv_nsec));
   }
   camroller_shaft_free(shaft);
   return 0;
}
