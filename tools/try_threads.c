/* Decks read, followers driven and a case that all share run in many threads at once, then the same work in one: every sum has to
 * have the same bits.
 *
 * Usage: threads DECK THREADS RUNS        each thread reads the deck RUNS times and drives a follower of it */
#include <camroller.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>

static const char *path;
static int runs;
static camroller_case *shared = NULL;

typedef struct {
   int number;
   double sum;
} job;

static void stop_on(int code, const camroller_error *error) {
   if (code == 0) return;
   fprintf(stderr, "%s\n", error->message);
   exit(1);
}

/* Friction of the case that all threads share, checked, run, and started as a shaft and as a follower */
static double share(void) {
   camroller_error error = {.size = sizeof error};
   camroller_result *result = NULL;
   camroller_shaft *shaft = NULL;
   camroller_simulation *follower = NULL;
   double friction;
   stop_on(camroller_case_check(shared, &error), &error);
   stop_on(camroller_shaft_new(shared, 0.0, 1, &shaft, &error), &error);
   stop_on(camroller_simulation_new(shared, 1, 0.0, &follower, &error), &error);
   stop_on(camroller_case_run(shared, &result, &error), &error);
   stop_on(camroller_result_scalar(result, "mean_torque_friction", &friction, &error), &error);
   camroller_result_free(result);
   camroller_shaft_free(shaft);
   camroller_simulation_free(follower);
   return friction;
}

static void *work(void *place) {
   job *own = place;
   own->sum = share();
   for (int run = 0; run < runs; run++) {
      camroller_error error = {.size = sizeof error};
      camroller_case *deck = NULL;
      camroller_simulation *follower = NULL;
      camroller_outcome outcome = {.size = sizeof outcome};
      camroller_inputs start = {.size = sizeof start, .speed = 30 + own->number % 7, .oil_temperature = 333.15 + run % 5};
      camroller_inputs end = start;
      end.speed += 1.0;
      stop_on(camroller_case_from_file(path, &deck, &error), &error);
      stop_on(camroller_simulation_new(deck, 1, 0.1 * run, &follower, &error), &error);
      for (int i = 1; i <= 4; i++) {
         stop_on(camroller_simulation_step(follower, 0.1 * run + 0.2 * i, &start, &end, &outcome, &error), &error);
         own->sum += outcome.mean_torque_drive + outcome.torque_friction;
      }
      camroller_simulation_free(follower);
      camroller_case_free(deck);
   }
   return NULL;
}

int main(int count, char **words) {
   if (count < 4) return 9;
   int threads = atoi(words[2]), different = 0;
   path = words[1];
   runs = atoi(words[3]);
   camroller_error error = {.size = sizeof error};
   stop_on(camroller_case_from_file(path, &shared, &error), &error);
   job *together = calloc((size_t)threads, sizeof *together), alone;
   pthread_t *ids = calloc((size_t)threads, sizeof *ids);
   for (int i = 0; i < threads; i++) {
      together[i].number = i;
      if (pthread_create(&ids[i], NULL, work, &together[i]) != 0) return 9;
   }
   for (int i = 0; i < threads; i++) pthread_join(ids[i], NULL);
   for (int i = 0; i < threads; i++) {
      alone.number = i;
      work(&alone);
      different += alone.sum != together[i].sum;
   }
   printf("%d of %d threads differ\n", different, threads);
   camroller_case_free(shared);
   free(together);
   free(ids);
   return different > 0;
}
