"""The library: its structs, its calls, errors as exceptions. `camroller.h` says what each call does."""

from __future__ import annotations

import ctypes
import pathlib
import re
from ctypes import POINTER, byref, c_char, c_char_p, c_double, c_int, c_size_t, c_void_p

#: Version of the header that these declarations follow: 100*major + minor
INTERFACE = 2


def encoded(text, what):
    """A text for the library, which takes none with a null character in it: it would end there."""
    if not isinstance(text, str):
        raise TypeError(f"{what} must be a str, not {type(text).__name__}")
    if "\0" in text:
        raise UsageError(f"{what} has a null character in it: {text!r}")
    return text.encode()


class CamrollerError(Exception):
    """What went wrong. `code` is the kind of the error, `line` the first line of a deck that it names, or None."""

    code = 70

    def __init__(self, message: str, cause: int = 0):
        super().__init__(message)
        self.message = message
        self.cause = cause
        found = re.search(r"^[^\n]*?:(\d+):\d+:", message, re.MULTILINE)
        self.line = int(found.group(1)) if found else None


class UsageError(CamrollerError, ValueError):
    """A call that cannot be: an unknown name, an angle that does not grow, a speed that is not above zero."""

    code = 2


class DeckError(CamrollerError, ValueError):
    """A mistake in a deck, or in a table that a deck names; `line` says where."""

    code = 3


class DomainError(CamrollerError, ValueError):
    """Numbers that describe something impossible, or a law outside its range where that is forbidden."""

    code = 4


class ConvergenceError(CamrollerError, ArithmeticError):
    """An iteration or integration that did not reach its tolerance."""

    code = 5


class FileError(CamrollerError, OSError):
    """A file that cannot be read."""

    code = 6

    __str__ = Exception.__str__


KINDS = {kind.code: kind for kind in (UsageError, DeckError, DomainError, ConvergenceError, FileError)}


class Struct(ctypes.Structure):
    """A struct whose first member is its size."""

    def __init__(self, **values):
        super().__init__(size=ctypes.sizeof(self), **values)

    def __repr__(self):
        names = [name for name, _ in self._fields_ if name != "size"]
        return f"{type(self).__name__}({', '.join(f'{name}={plain(getattr(self, name))}' for name in names)})"


def plain(value):
    """A number or a tuple of them."""
    return tuple(value) if isinstance(value, ctypes.Array) else value


class ErrorStruct(Struct):
    _fields_ = [("size", c_size_t), ("code", c_int), ("cause", c_int), ("message", c_char * 4096)]


class Inputs(Struct):
    """What a host gives at an end of a step: cam speed above zero [rad/s], oil temperature [K], the gauge pressure that presses the
    valve shut [Pa] and that of the oil at the lash adjuster [Pa]; None: that of the case."""

    _fields_ = [("size", c_size_t), ("speed", c_double), ("oil_temperature", c_double), ("_gas_pressure", c_double),
                ("_has_pressure", c_int), ("_has_supply", c_int), ("_supply_pressure", c_double)]

    def __init__(self, speed, oil_temperature, gas_pressure=None, supply_pressure=None):
        super().__init__(speed=speed, oil_temperature=oil_temperature)
        self.gas_pressure, self.supply_pressure = gas_pressure, supply_pressure

    @property
    def gas_pressure(self):
        """Gauge pressure that presses the valve shut [Pa]; None: that of the case."""
        return self._gas_pressure if self._has_pressure else None

    @gas_pressure.setter
    def gas_pressure(self, pressure):
        self._has_pressure, self._gas_pressure = pressure is not None, pressure or 0.0

    @property
    def supply_pressure(self):
        """Gauge pressure of the oil at the lash adjuster [Pa]; None: that of the case."""
        return self._supply_pressure if self._has_supply else None

    @supply_pressure.setter
    def supply_pressure(self, pressure):
        self._has_supply, self._supply_pressure = pressure is not None, pressure or 0.0


class Outcome(Struct):
    """What a step gives for one follower: torques [N m], mean over the step and at its end, all, for losses, and by source (against
    spring, masses and gas; contact; roller bearing; valve guide; inertia of the roller; `torque_others`: all other sources together);
    force on the cam [N]; smallest and largest load [N], torque [N m] and sliding speed [m/s], largest pressure [Pa], smallest
    film [m]; estimate of the error of `mean_torque_drive`."""

    _fields_ = [("size", c_size_t), ("mean_torque_drive", c_double), ("torque_drive", c_double),
                ("mean_torque_friction", c_double), ("torque_friction", c_double), ("mean_torques", c_double * 5),
                ("torques", c_double * 5), ("cam_force", c_double * 2), ("contact_load", c_double * 2),
                ("extreme_torque", c_double * 2), ("sliding_speed", c_double * 2), ("largest_pressure", c_double),
                ("smallest_film", c_double), ("estimated_error", c_double), ("mean_torque_others", c_double),
                ("torque_others", c_double)]


class Cam(Struct):
    """Where a cam stands: lobe shape, camshaft, angle by which its event follows the first cam's [rad]."""

    _fields_ = [("size", c_size_t), ("lobe", c_int), ("camshaft", c_int), ("phase", c_double)]


class ShaftOutcome(Struct):
    """What a step gives for all camshafts together: torques [N m], mean over the step and at its end, all, for losses, of the
    camshaft bearings, and by source as in `Outcome`; smallest and largest torque that drives; estimate of the error of
    `mean_torque_drive`."""

    _fields_ = [("size", c_size_t), ("mean_torque_drive", c_double), ("torque_drive", c_double),
                ("mean_torque_friction", c_double), ("torque_friction", c_double), ("mean_torque_bearings", c_double),
                ("torque_bearings", c_double), ("mean_torques", c_double * 5), ("torques", c_double * 5),
                ("extreme_torque", c_double * 2), ("estimated_error", c_double), ("mean_torque_others", c_double),
                ("torque_others", c_double)]


ERROR = POINTER(ErrorStruct)
PLACE = POINTER(c_void_p)
NUMBERS = POINTER(c_double)
TEXTS = POINTER(c_void_p)
#: Calls that can fail: their arguments before the error struct
CALLS = {
    "case_from_text": (c_char_p, c_char_p, PLACE),
    "case_from_file": (c_char_p, PLACE),
    "case_set_all": (c_void_p, c_size_t, POINTER(c_char_p), POINTER(c_char_p)),
    "case_check": (c_void_p,),
    "case_copy": (c_void_p, PLACE),
    "case_number": (c_void_p, c_size_t, TEXTS, c_size_t, NUMBERS),
    "case_sweep_value": (c_void_p, c_size_t, c_size_t, TEXTS, c_size_t),
    "case_sweep_case": (c_void_p, c_size_t, PLACE),
    "case_run": (c_void_p, PLACE),
    "result_scalar": (c_void_p, c_char_p, NUMBERS),
    "result_series": (c_void_p, c_char_p, NUMBERS, c_size_t),
    "result_quantity": (c_void_p, c_int, c_size_t, TEXTS, c_size_t),
    "simulation_new": (c_void_p, c_int, c_double, PLACE),
    "simulation_step": (c_void_p, c_double, POINTER(Inputs), POINTER(Inputs), POINTER(Outcome)),
    "simulation_value": (c_void_p, c_char_p, NUMBERS),
    "simulation_remark": (c_void_p, c_size_t, TEXTS, c_size_t),
    "simulation_halt": (c_void_p,),
    "simulation_copy": (c_void_p, PLACE),
    "simulation_save": (c_void_p, c_char_p, c_size_t),
    "simulation_restore": (c_void_p, c_char_p, c_size_t, PLACE),
    "shaft_new": (c_void_p, c_double, c_int, PLACE),
    "shaft_cam": (c_void_p, c_int, POINTER(Cam)),
    "shaft_step": (c_void_p, c_double, POINTER(Inputs), POINTER(Inputs), NUMBERS, POINTER(ShaftOutcome)),
    "shaft_follower": (c_void_p, c_int, POINTER(Outcome)),
    "shaft_value": (c_void_p, c_int, c_char_p, NUMBERS),
    "shaft_values": (c_void_p, c_int, NUMBERS, c_size_t),
    "shaft_quantity": (c_void_p, c_int, c_size_t, TEXTS, c_size_t),
    "shaft_remark": (c_void_p, c_size_t, TEXTS, c_size_t),
    "shaft_halt": (c_void_p,),
    "shaft_copy": (c_void_p, PLACE),
    "shaft_save": (c_void_p, c_char_p, c_size_t),
    "shaft_restore": (c_void_p, c_char_p, c_size_t, c_int, PLACE),
}
#: Calls that cannot: what they return, their arguments
PLAIN = {
    "library_version": (c_int,),
    "library_version_text": (None, c_char_p, c_size_t),
    "use_one_blas_thread": (c_int,),
    "case_free": (None, c_void_p),
    "case_sweep_size": (c_size_t, c_void_p),
    "case_remarks": (None, c_void_p, c_char_p, c_size_t),
    "result_rows": (c_size_t, c_void_p),
    "result_remarks": (None, c_void_p, c_char_p, c_size_t),
    "result_free": (None, c_void_p),
    "simulation_angle": (c_double, c_void_p),
    "simulation_save_size": (c_size_t,),
    "simulation_free": (None, c_void_p),
    "shaft_cams": (c_int, c_void_p),
    "shaft_angle": (c_double, c_void_p),
    "shaft_save_size": (c_size_t, c_void_p),
    "shaft_free": (None, c_void_p),
}


def load_library():
    """The library that the wheel brought, with its calls declared."""
    paths = sorted((pathlib.Path(__file__).parent / "lib").glob("libcamroller_bundle.so*"))
    if not paths:
        raise ImportError("camroller: the library is not beside the package; install the wheel")
    library = ctypes.CDLL(str(paths[0]))
    for name, arguments in CALLS.items():
        function = getattr(library, f"camroller_{name}")
        function.restype = c_int
        function.argtypes = [*arguments, ERROR]
    for name, (result, *arguments) in PLAIN.items():
        function = getattr(library, f"camroller_{name}")
        function.restype = result
        function.argtypes = arguments
    if library.camroller_library_version() // 100 != INTERFACE:
        raise ImportError("camroller: the library beside the package belongs to another version of it")
    # of the OpenBLAS beside it, that of numpy's wheel keeps its threads; where the process has loaded a libopenblas.so.0 before, the
    # loader takes that one, and it has one thread from here on
    library.camroller_use_one_blas_thread()
    return library


LIBRARY = load_library()


def call(name, *arguments):
    """Make a call; what goes wrong is raised."""
    error = ErrorStruct()
    code = getattr(LIBRARY, f"camroller_{name}")(*arguments, byref(error))
    if code != 0:
        kind = KINDS.get(code, CamrollerError)
        raise kind(error.message.decode(errors="replace"), error.cause)


def list_texts(name, count, *arguments, after=(), room=1024, least=0):
    """Texts of a call that lists something by its place, until there are no more; the library's error where there are fewer than
    `least`."""
    number = 0
    while True:
        buffers = [ctypes.create_string_buffer(room) for _ in range(count)]
        texts = (c_void_p * count)(*[ctypes.addressof(buffer) for buffer in buffers])
        try:
            call(name, *arguments, number, texts, room, *after)
        except UsageError:
            if number < least:
                raise
            return
        yield tuple(buffer.value.decode() for buffer in buffers)
        number += 1


def list_remarks(name, pointer):
    """Sentences of a call that gives remarks, one a line."""
    buffer = ctypes.create_string_buffer(65536)
    getattr(LIBRARY, f"camroller_{name}")(pointer, buffer, len(buffer))
    return buffer.value.decode().splitlines()


class Handle:
    """Something of the library, freed when nothing refers to it any more."""

    _kind = ""

    def __init__(self, pointer):
        self._pointer = pointer

    def __del__(self):
        if self.__dict__.get("_pointer"):
            getattr(LIBRARY, f"camroller_{self._kind}_free")(self._pointer)
            self._pointer = None

    def copy(self):
        """A copy, which goes its own way."""
        return type(self)._make(f"{self._kind}_copy", self._pointer)

    def __copy__(self):
        return self.copy()

    def __deepcopy__(self, memo):
        return self.copy()

    def __reduce_ex__(self, protocol):
        raise TypeError(f"a {type(self).__name__} of camroller cannot be pickled: it lives in the library of this process"
                        + self._instead)

    #: What a message about pickling says of other ways
    _instead = ""

    @classmethod
    def _make(cls, name, *arguments):
        """What a call makes."""
        place = c_void_p()
        call(name, *arguments, byref(place))
        made = cls.__new__(cls)
        Handle.__init__(made, place)
        return made

    def _take(self, name, *arguments):
        """Become what a call makes."""
        place = c_void_p()
        call(name, *arguments, byref(place))
        Handle.__init__(self, place)
