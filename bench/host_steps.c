/* A host that steps all followers of a deck over half a degree of cam angle each: for bench/hosts.py, which counts what a step costs.
 * Usage: host_steps DECK STEPS */
#include <camroller.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

int main(int count, char **words) {
   const double step = 3.14159265358979323846 / 360.0;
   camroller_error error = {.size = sizeof error};
   camroller_case *deck = NULL;
   camroller_shaft *shaft = NULL;
   camroller_inputs ends[2] = {{.size = sizeof ends[0]}, {.size = sizeof ends[0]}};
   camroller_shaft_outcome outcome = {.size = sizeof outcome};
   if (count < 3) return 9;
   if (camroller_case_from_file(words[1], &deck, &error) || camroller_shaft_new(deck, 0.0, 1, &shaft, &error)) {
      fprintf(stderr, "%s\n", error.message);
      return 1;
   }
   clock_t begin = clock();
   for (int i = 0; i < atoi(words[2]); i++) {
      for (int end = 0; end < 2; end++) {
         ends[end].speed = 100.0 * (1.0 + 0.02 * sin(4.0 * step * (i + end)));
         ends[end].oil_temperature = 363.15;
      }
      if (camroller_shaft_step(shaft, step * (i + 1), &ends[0], &ends[1], NULL, &outcome, &error)) {
         fprintf(stderr, "%s\n", error.message);
         return 1;
      }
   }
   printf("%d %.6f\n", camroller_shaft_cams(shaft), (double)(clock() - begin) / CLOCKS_PER_SEC);
   camroller_shaft_free(shaft);
   camroller_case_free(deck);
   return 0;
}
