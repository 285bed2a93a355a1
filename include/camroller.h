/* camroller: friction, film, slip and drive torque of roller-finger-follower valve trains, for C and all that calls C.
 *
 * Every call that can fail returns 0, or the kind of what went wrong, and fills the caller's error struct, which may be NULL.
 * No call prints or ends the program. What a call makes is given in `*out`, NULL where there is an error. What is freed may be NULL.
 *
 * SI units and radians everywhere; cam angles have the nose, full lift, at pi and grow with the turns. Values of deck keys alone
 * have the unit that the key's name says.
 *
 * Threads: different objects in different threads, at any time. A case is only read by camroller_case_run, camroller_case_check and
 * by what makes a simulation or a shaft of it, so that threads may share it there.
 */
#ifndef CAMROLLER_H
#define CAMROLLER_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Version that this header belongs to: 10000*major + 100*minor + patch. While major is 0, programs need the same major and minor:
 * camroller_library_version()/100 == CAMROLLER_VERSION/100. */
#define CAMROLLER_VERSION 200
int camroller_library_version(void);
void camroller_library_version_text(char *buffer, size_t room);

/* One thread for OpenBLAS, in the whole process, to be called before the first case: its own threads cost more than they bring,
 * most of all beside those of the host, and with them last digits of numerical films depend on their number. 1 where that is done,
 * 0 where the library of linear algebra is another one, or not found since it is linked statically: nothing is changed then. */
int camroller_use_one_blas_thread(void);

/* Kinds of errors: what calls return */
enum {
   CAMROLLER_OK = 0,
   CAMROLLER_USAGE = 2,       /* a call that cannot be: NULL, an unknown name, an angle that does not grow */
   CAMROLLER_DECK = 3,        /* a mistake in a deck or a table that a deck names */
   CAMROLLER_DOMAIN = 4,      /* numbers that describe something impossible, or a law outside its range where that is forbidden */
   CAMROLLER_CONVERGENCE = 5, /* an iteration or integration that did not reach its tolerance */
   CAMROLLER_FILE = 6,        /* a file that cannot be read */
   CAMROLLER_INTERNAL = 70    /* a broken promise inside the library */
};

/* Set `size` to sizeof(camroller_error) before the first call */
typedef struct {
   size_t size;
   int code;           /* one of the kinds above */
   int cause;          /* 0, or a number that tells errors of one kind apart */
   char message[4096]; /* one sentence, or one line for each mistake of a deck; cut where it is longer */
} camroller_error;

typedef struct camroller_case camroller_case;
typedef struct camroller_result camroller_result;
typedef struct camroller_simulation camroller_simulation;
typedef struct camroller_shaft camroller_shaft;

/* A case from the text or the file of a deck. Paths of tables start at `folder` (NULL: the present folder) or at the deck's own. */
int camroller_case_from_text(const char *text, const char *folder, camroller_case **out, camroller_error *error);
int camroller_case_from_file(const char *path, camroller_case **out, camroller_error *error);
/* Give a key, named `group.key`, another value, as a deck would; the case stays as it was where that fails. */
int camroller_case_set(camroller_case *self, const char *key, const char *value, camroller_error *error);
/* The same with `count` keys at once, for those that a deck can only have together. */
int camroller_case_set_all(camroller_case *self, size_t count, const char *const keys[], const char *const values[],
                           camroller_error *error);
/* Laws, geometry and oil, without a run */
int camroller_case_check(const camroller_case *self, camroller_error *error);
int camroller_case_copy(const camroller_case *self, camroller_case **out, camroller_error *error);
void camroller_case_free(camroller_case *self);
/* Keys that the deck gives with one number each, by their place, from 0: name, unit and meaning, three buffers of `room` characters,
 * any or all of them NULL, and the value in that unit. CAMROLLER_USAGE tells that there are no more. */
int camroller_case_number(const camroller_case *self, size_t number, char *const texts[3], size_t room, double *value,
                          camroller_error *error);
/* Remarks on the deck, one a line, empty where there are none: numbers that no engine has, keys without effect, a choice of
 * effects, which is of runs. A run has others, see camroller_result_remarks. */
void camroller_case_remarks(const camroller_case *self, char *buffer, size_t room);
/* Cases of the deck's sweep, 1 without one. A case stands for its deck without the sweep; the case of a number, from 0, is made
 * of it, with the sweep's values of the keys that vary, whatever was set for them. Name of a key that varies, from 0, and its value
 * in a case as a deck has it; CAMROLLER_USAGE tells that there are no more. */
size_t camroller_case_sweep_size(const camroller_case *self);
int camroller_case_sweep_value(const camroller_case *self, size_t number, size_t key, char *const texts[2], size_t room,
                               camroller_error *error);
int camroller_case_sweep_case(const camroller_case *self, size_t number, camroller_case **out, camroller_error *error);

/* Run a case. */
int camroller_case_run(const camroller_case *self, camroller_result **out, camroller_error *error);
/* Scalars and series by name; units by camroller_result_unit. The series `cam_angle` holds the angle of each row, in radians. */
int camroller_result_scalar(const camroller_result *self, const char *name, double *value, camroller_error *error);
size_t camroller_result_rows(const camroller_result *self);
int camroller_result_series(const camroller_result *self, const char *name, double *values, size_t room, camroller_error *error);
int camroller_result_unit(const camroller_result *self, const char *name, char *buffer, size_t room, camroller_error *error);
/* Name, unit and meaning of quantity `number`, from 0, of the series (kind 0) or the scalars (kind 1): three buffers of `room`
 * characters, any or all of them NULL. CAMROLLER_USAGE tells that there are no more. */
int camroller_result_quantity(const camroller_result *self, int kind, size_t number, char *const texts[3], size_t room,
                              camroller_error *error);
/* Remarks, one a line; empty where there are none */
void camroller_result_remarks(const camroller_result *self, char *buffer, size_t room);
void camroller_result_free(camroller_result *self);

/* What a host gives at an end of a step; between both ends everything is linear in the cam angle.
 * Set `size` to sizeof(camroller_inputs). */
typedef struct {
   size_t size;
   double speed;           /* of the cam, above zero [rad/s] */
   double oil_temperature; /* [K] */
   double gas_pressure;    /* gauge, pressing the valve shut [Pa] */
   int has_pressure;       /* 1: in the place of the case's table, whose group &gas_force gives the valve's area; 0: the table, with gas_pressure 0 */
   int has_supply;         /* 1: supply pressure in the place of that of the case, which needs a lash adjuster; 0: that of the case, with supply_pressure 0 */
   double supply_pressure; /* gauge, of the oil at the lash adjuster, 0 or more [Pa] */
} camroller_inputs;

/* What a step gives. Set `size` to sizeof(camroller_outcome). */
typedef struct {
   size_t size;
   double mean_torque_drive, torque_drive;       /* mean over the step and at its end [N m] */
   double mean_torque_friction, torque_friction; /* the part for losses [N m] */
   /* by source: against spring, masses and gas; contact; roller bearing; valve guide; inertia of the roller [N m]. All of the drive
    * with `mean_torque_others` below */
   double mean_torques[5], torques[5];
   /* of the follower on the cam at the end, x from the finger's pivot to the cam's centre, y at a right angle to x, to the side to
    * which the finger turns as it opens the valve [N] */
   double cam_force[2];
   /* smallest and largest within the step, at the points that its means are made of */
   double contact_load[2];   /* [N] */
   double extreme_torque[2]; /* torque that drives [N m] */
   double sliding_speed[2];  /* [m/s] */
   double largest_pressure;  /* of the dry contact, anywhere along the roller [Pa] */
   double smallest_film;     /* anywhere along the roller [m]; huge where there is no contact all the step */
   /* of the mean torque that drives: what the case's accuracy leaves, not what inputs differ from straight lines [N m] */
   double estimated_error;
   /* by all other sources together, as a case has them: oil in the roller's bearing, valve tip, stem seal, ends of the guide, finger's
    * pivot, dampers and leak; one by one at the end of a step by camroller_simulation_value, `torque_tip` and so on [N m] */
   double mean_torque_others, torque_others;
} camroller_outcome;

/* A follower at a cam angle; lobe 1 is the case's lift, 2 its second lift. A flexible train (&dynamics) starts at rest on the base
 * circle, opposite full lift, and is driven to the angle at the operating point of the case, which takes the time of a turn. */
int camroller_simulation_new(const camroller_case *self, int lobe, double cam_angle, camroller_simulation **out,
                             camroller_error *error);
/* Advance to a cam angle beyond the present one. A step that fails leaves the follower as it was, to the last bit. */
int camroller_simulation_step(camroller_simulation *self, double cam_angle, const camroller_inputs *start,
                              const camroller_inputs *end, camroller_outcome *outcome, camroller_error *error);
/* Number at the end of the last step that did not fail, by the name of a follower's series, or of a series of the case's torques by
 * source, for this follower's part of it */
int camroller_simulation_value(const camroller_simulation *self, const char *name, double *value, camroller_error *error);
/* Remark `number`, from 0, on the last step: contact lost, laws outside their ranges, films too thin for them. Two buffers of `room`
 * characters, either or both NULL, for the name of its kind, the same in every step, and for its words. CAMROLLER_USAGE tells that
 * there are no more; most steps have none. */
int camroller_simulation_remark(const camroller_simulation *self, size_t number, char *const texts[2], size_t room,
                                camroller_error *error);
double camroller_simulation_angle(const camroller_simulation *self);
/* The engine has stopped: the roller comes to rest, and the next step starts without spin; a flexible train comes to rest. */
int camroller_simulation_halt(camroller_simulation *self, camroller_error *error);
/* A copy, e.g. to go back to; a block of bytes, from which the same case makes the same follower in another process. */
int camroller_simulation_copy(const camroller_simulation *self, camroller_simulation **out, camroller_error *error);
size_t camroller_simulation_save_size(void); /* the same for every case */
int camroller_simulation_save(const camroller_simulation *self, void *buffer, size_t room, camroller_error *error);
int camroller_simulation_restore(const camroller_case *self, const void *buffer, size_t bytes, camroller_simulation **out,
                                 camroller_error *error);
void camroller_simulation_free(camroller_simulation *self);

/* All followers of a case, with their camshafts and the bearings that carry them. Without camshaft bearings a case has one cam. Cam
 * angles are those of the first cam. `threads` share the followers in a step; bits do not depend on their number. */
int camroller_shaft_new(const camroller_case *self, double cam_angle, int threads, camroller_shaft **out, camroller_error *error);
/* Number of cams; where one stands. Set `size` to sizeof(camroller_cam). */
typedef struct {
   size_t size;
   int lobe, camshaft; /* from 1 */
   double phase;       /* by which its event follows the first cam's [rad] */
} camroller_cam;
int camroller_shaft_cams(const camroller_shaft *self);
int camroller_shaft_cam(const camroller_shaft *self, int cam, camroller_cam *facts, camroller_error *error);

/* What a step gives for all camshafts together. Set `size` to sizeof(camroller_shaft_outcome). */
typedef struct {
   size_t size;
   double mean_torque_drive, torque_drive;       /* mean over the step and at its end [N m] */
   double mean_torque_friction, torque_friction; /* the part for losses [N m] */
   double mean_torque_bearings, torque_bearings; /* the part of that for the camshaft bearings [N m] */
   /* of all followers by source, as in camroller_outcome [N m] */
   double mean_torques[5], torques[5];
   /* smallest and largest torque that drives, at angles a degree apart or less; narrow peaks between them are seen with one cam and
    * no bearings alone, and in what camroller_shaft_follower gives of each cam [N m] */
   double extreme_torque[2];
   double estimated_error;   /* of the mean torque that drives, as in camroller_outcome [N m] */
   /* of all followers, as in camroller_outcome, and the seals and the drive of the camshafts (&shaft_drag) [N m] */
   double mean_torque_others, torque_others;
} camroller_shaft_outcome;
/* Advance to a cam angle beyond the present one. `gas_pressures` has one for each cam's valve at the start, then one for each at the
 * end [Pa]; NULL: those of the inputs, for every cam, or of the case's table. A step that fails leaves all followers as they were,
 * to the last bit. */
int camroller_shaft_step(camroller_shaft *self, double cam_angle, const camroller_inputs *start, const camroller_inputs *end,
                         const double *gas_pressures, camroller_shaft_outcome *outcome, camroller_error *error);
/* What the last step gave for the follower of a cam, from 1 */
int camroller_shaft_follower(const camroller_shaft *self, int cam, camroller_outcome *outcome, camroller_error *error);
/* Numbers at the end of the last step that did not fail: of the follower of a cam, from 1, or of the camshafts, 0. One by its name,
 * as camroller_simulation_value takes it, or all in the order of camroller_shaft_quantity, which gives name, unit and meaning of the
 * number at a place, from 0, as camroller_result_quantity does. */
int camroller_shaft_value(const camroller_shaft *self, int cam, const char *name, double *value, camroller_error *error);
int camroller_shaft_values(const camroller_shaft *self, int cam, double *values, size_t room, camroller_error *error);
int camroller_shaft_quantity(const camroller_shaft *self, int cam, size_t number, char *const texts[3], size_t room,
                             camroller_error *error);
/* As camroller_simulation_remark, of all cams and of the bearings at the end of the step; one on a cam begins with its number */
int camroller_shaft_remark(const camroller_shaft *self, size_t number, char *const texts[2], size_t room, camroller_error *error);
double camroller_shaft_angle(const camroller_shaft *self);
int camroller_shaft_halt(camroller_shaft *self, camroller_error *error);
int camroller_shaft_copy(const camroller_shaft *self, camroller_shaft **out, camroller_error *error);
size_t camroller_shaft_save_size(const camroller_shaft *self);
int camroller_shaft_save(const camroller_shaft *self, void *buffer, size_t room, camroller_error *error);
int camroller_shaft_restore(const camroller_case *self, const void *buffer, size_t bytes, int threads, camroller_shaft **out,
                            camroller_error *error);
void camroller_shaft_free(camroller_shaft *self);

#ifdef __cplusplus
}
#endif

#endif
