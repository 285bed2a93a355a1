/* A host for bench/hosts.py, which counts what a step costs: steps all followers of a deck over DEGREES of cam angle each, or with
 * DEGREES zero runs the deck COUNT times at the mean of the same inputs. Cam speed 100 rad/s with a ripple, oil at 90 C.
 * Prints the number of cams, that of cams with the second lobe shape, and the processor time.
 * Usage: host_steps DECK COUNT DEGREES SPEED_RPM, the last being the deck's speed for a run */
#include <camroller.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static camroller_error error = {.size = sizeof error};

static int fail(void) {
   fprintf(stderr, "%s\n", error.message);
   return 1;
}

int main(int count, char **words) {
   camroller_case *deck = NULL;
   camroller_shaft *shaft = NULL;
   camroller_result *result = NULL;
   camroller_inputs ends[2] = {{.size = sizeof ends[0]}, {.size = sizeof ends[0]}};
   camroller_shaft_outcome outcome = {.size = sizeof outcome};
   camroller_cam cam = {.size = sizeof cam};
   int seconds = 0;
   if (count < 5) return 9;
   const double step = atof(words[3]) * 3.14159265358979323846 / 180.0;
   if (camroller_case_from_file(words[1], &deck, &error) || camroller_case_set(deck, "operating_point.speed_rpm", words[4], &error) ||
       camroller_case_set(deck, "operating_point.oil_temperature_degC", "90", &error) ||
       camroller_shaft_new(deck, 0.0, 1, &shaft, &error))
      return fail();
   clock_t begin = clock();
   for (int i = 0; i < atoi(words[2]); i++) {
      if (step <= 0.0) {
         if (camroller_case_run(deck, &result, &error)) return fail();
         camroller_result_free(result);
         continue;
      }
      for (int end = 0; end < 2; end++) {
         ends[end].speed = 100.0 * (1.0 + 0.02 * sin(4.0 * step * (i + end)));
         ends[end].oil_temperature = 363.15;
      }
      if (camroller_shaft_step(shaft, step * (i + 1), &ends[0], &ends[1], NULL, &outcome, &error)) return fail();
   }
   for (int i = 1; i <= camroller_shaft_cams(shaft); i++) {
      if (camroller_shaft_cam(shaft, i, &cam, &error)) return fail();
      seconds += cam.lobe == 2;
   }
   printf("%d %d %.6f\n", camroller_shaft_cams(shaft), seconds, (double)(clock() - begin) / CLOCKS_PER_SEC);
   camroller_shaft_free(shaft);
   camroller_case_free(deck);
   return 0;
}
