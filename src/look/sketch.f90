!> The mechanism of a case drawn to scale, as SVG: cam, roller, finger, valve, with the lengths and angles that a deck gives.
!>
!> In: a case. Out: the text of a drawing. One unit of the drawing is a tenth of a millimetre. The pivot is the origin, the valve's
!> axis upright, the valve below; the cam stands at its base circle, and the finger at full lift is dashed.
module camroller_sketch
   use camroller_kinds, only : wp, pi, degree, two_pi
   use camroller_error, only : error_t
   use camroller_case, only : case_t
   use camroller_kinematics, only : position_t
   use camroller_model, only : model_t, evaluate_geometry
   use camroller_number_text, only : fixed_text, number_text
   use camroller_output_kind, only : drawing_kind
   use camroller_quotes, only : xml_text
   use camroller_run, only : build_models
   implicit none
   private

   public :: draw_mechanism

   !> Units of the drawing in a metre, its margin, height of letters, and of its legend for each line [unit]
   real(wp), parameter :: scale = 1.0e4_wp, margin = 60.0_wp, letters = 15.0_wp, line_height = 20.0_wp
   !> Points of the cam's contour
   integer, parameter :: points = 720
   character(len=*), parameter :: n = new_line("a")
   !> Colours: of the cam, the finger, the roller, angles, lengths
   character(len=*), parameter :: cam_colour = "#8a5a00", finger_colour = "#1f4e8c", roller_colour = "#2a7d2e", &
      & angle_colour = "#a01c48", grey = "#666666"

contains

   !> Draw the mechanism of a case.
   subroutine draw_mechanism(case, drawing, error)
      !> The case
      type(case_t), intent(in) :: case
      !> The drawing
      character(len=:), allocatable, intent(out) :: drawing
      !> Deck or domain error of its models
      type(error_t), allocatable, intent(out) :: error

      type(model_t), allocatable :: models(:)
      ! Contour of the cam, cam centre, and centres of roller and pad on the base circle and at full lift [m]
      real(wp) :: contour(2, points), cam(2), roller(2, 2), pad(2, 2)
      ! Corners of the drawing [m]
      real(wp) :: low(2), high(2)
      character(len=:), allocatable :: body

      call build_models(case, models, error)
      if (allocated(error)) return
      call find_places(case, models(1), cam, roller, pad)
      call find_contour(models(1), cam, contour)
      low = min(minval(contour, 2), minval(pad, 2), [0.0_wp, 0.0_wp]) - [6.0e-3_wp, 16.0e-3_wp]
      high = max(maxval(contour, 2), maxval(pad, 2)) + [23.0e-3_wp, 4.0e-3_wp]
      body = ""
      call draw_cam(case, contour, cam, body)
      call draw_finger(case, roller, pad, body)
      call draw_angles(case, models(1), cam, body)
      call put_in_frame(case, body, low, high, drawing)
   end subroutine draw_mechanism

   !> Point at a distance and an angle from the pivot.
   pure function polar(radius, angle) result(point)
      !> Distance [m]
      real(wp), intent(in) :: radius
      !> Angle, against the clock from the right [rad]
      real(wp), intent(in) :: angle
      !> The point [m]
      real(wp) :: point(2)

      point = radius*[cos(angle), sin(angle)]
   end function polar

   !> Places of cam, roller and pad.
   subroutine find_places(case, model, cam, roller, pad)
      type(case_t), intent(in) :: case
      type(model_t), intent(in) :: model
      !> Cam centre [m]
      real(wp), intent(out) :: cam(2)
      !> Centres of roller and pad, on the base circle and at full lift [m]
      real(wp), intent(out) :: roller(2, 2), pad(2, 2)

      type(position_t) :: position
      ! Direction of the cam's centre [rad]
      real(wp) :: direction
      integer :: i, status

      direction = 0.5_wp*pi - case%mechanism%valve_axis_angle
      cam = polar(model%linkage%d, direction)
      do i = 1, 2
         call evaluate_geometry(model, merge(pi, 0.0_wp, i == 1), position, status)
         roller(:, i) = polar(model%linkage%a, direction - position%arm_angle)
         pad(:, i) = polar(model%linkage%b, direction - position%arm_angle + case%mechanism%roller_arm_angle)
      end do
   end subroutine find_places

   !> Contour of the cam with its base circle at the roller: the path of the roller's centre seen from the cam, less the roller.
   subroutine find_contour(model, cam, contour)
      type(model_t), intent(in) :: model
      !> Cam centre [m]
      real(wp), intent(in) :: cam(2)
      !> Its contour [m]
      real(wp), intent(out) :: contour(2, points)

      type(position_t) :: position
      ! Path of the roller's centre, seen from the cam; its direction; towards the cam [m, -, -]
      real(wp) :: path(2, points), tangent(2), inward(2)
      ! Place of the roller's centre from the cam's [m]; cam angle from full lift, turn of the cam [rad]
      real(wp) :: place(2), angle, turn
      integer :: i, status

      do i = 1, points
         angle = two_pi*(i - 1)/points - pi
         call evaluate_geometry(model, angle, position, status)
         place = polar(model%linkage%a, atan2(cam(2), cam(1)) - position%arm_angle) - cam
         turn = -model%linkage%sense*(angle + pi)
         path(:, i) = [cos(turn)*place(1) - sin(turn)*place(2), sin(turn)*place(1) + cos(turn)*place(2)]
      end do
      do i = 1, points
         tangent = path(:, modulo(i, points) + 1) - path(:, modulo(i - 2, points) + 1)
         inward = [-tangent(2), tangent(1)]/norm2(tangent)
         if (dot_product(inward, path(:, i)) > 0.0_wp) inward = -inward
         contour(:, i) = cam + path(:, i) + model%linkage%roller_radius*inward
      end do
   end subroutine find_contour

   !> Cam and its base circle.
   subroutine draw_cam(case, contour, cam, body)
      type(case_t), intent(in) :: case
      !> Contour and centre of the cam [m]
      real(wp), intent(in) :: contour(:, :), cam(2)
      !> Drawing so far
      character(len=:), allocatable, intent(inout) :: body

      integer :: i

      body = body//'<path fill="#f3e3c3" stroke="'//cam_colour//'" stroke-width="2" d="M'
      do i = 1, size(contour, 2)
         body = body//" "//pair(contour(:, i))
      end do
      body = body//' Z"/>'//n
      call add_circle(cam, case%mechanism%base_radius, 'fill="none" stroke="'//cam_colour//'" stroke-dasharray="6 5"', body)
      call add_circle(cam, 6.0e-4_wp, 'fill="'//cam_colour//'"', body)
      call add_line([0.0_wp, 0.0_wp], cam, 'stroke="'//grey//'" stroke-dasharray="9 4 2 4"', body)
      call add_text(cam + [1.0e-3_wp, 1.0e-3_wp], "cam", cam_colour, body)
   end subroutine draw_cam

   !> Finger, roller, pad and valve; at full lift dashed.
   subroutine draw_finger(case, roller, pad, body)
      type(case_t), intent(in) :: case
      !> Centres of roller and pad, on the base circle and at full lift [m]
      real(wp), intent(in) :: roller(2, 2), pad(2, 2)
      !> Drawing so far
      character(len=:), allocatable, intent(inout) :: body

      character(len=:), allocatable :: style
      real(wp), parameter :: pivot(2) = [0.0_wp, 0.0_wp] ! [m]
      integer :: i

      do i = 2, 1, -1
         style = 'fill="none" stroke-width="'//trim(merge("3", "1", i == 1))//'" stroke="'//finger_colour//'"'
         if (i == 2) style = style//' stroke-dasharray="5 5"'
         call add_line(pivot, roller(:, i), style, body)
         call add_line(pivot, pad(:, i), style, body)
         call add_circle(roller(:, i), case%mechanism%roller_radius, 'fill="none" stroke="'//roller_colour//'" stroke-width="'// &
            & trim(merge('2"                       ', '1" stroke-dasharray="5 5"', i == 1)), body)
      end do
      call add_circle(roller(:, 1), case%mechanism%roller_radius - case%roller%wall_thickness, 'fill="none" stroke="'// &
         & roller_colour//'"', body)
      call add_circle(pivot, 1.2e-3_wp, 'fill="'//finger_colour//'"', body)
      call add_circle(pad(:, 1), 8.0e-4_wp, 'fill="'//finger_colour//'"', body)
      call add_line(pad(:, 1), pad(:, 1) - [0.0_wp, 14.0e-3_wp], 'stroke="'//grey//'" stroke-width="7"', body)
      call add_text([-5.5e-3_wp, -3.2e-3_wp], "pivot", finger_colour, body)
      call add_text(pad(:, 1) + [1.2e-3_wp, -10.0e-3_wp], "valve", grey, body)
      call add_text(roller(:, 1) - [0.0_wp, case%mechanism%roller_radius + 2.0e-3_wp], "roller", roller_colour, body)
   end subroutine draw_finger

   !> Arcs of the angles about the pivot, with their names and sizes.
   subroutine draw_angles(case, model, cam, body)
      type(case_t), intent(in) :: case
      type(model_t), intent(in) :: model
      !> Cam centre [m]
      real(wp), intent(in) :: cam(2)
      !> Drawing so far
      character(len=:), allocatable, intent(inout) :: body

      ! Directions of the valve's axis, the cam's centre, pad and roller [rad]
      real(wp) :: axis, centre, pad, roller

      axis = 0.5_wp*pi
      centre = atan2(cam(2), cam(1))
      pad = centre - model%linkage%base_angle
      roller = pad - case%mechanism%roller_arm_angle
      call add_line([0.0_wp, 0.0_wp], [0.0_wp, 0.6_wp*model%linkage%d], 'stroke="'//grey//'" stroke-dasharray="3 4"', body)
      call add_text([5.0e-4_wp, 0.6_wp*model%linkage%d], "parallel to the valve's axis", grey, body)
      call add_arc(0.36_wp*model%linkage%d, centre, axis, "valve_axis_angle "//degrees(case%mechanism%valve_axis_angle), body)
      call add_arc(0.24_wp*model%linkage%d, pad, centre, "pad from cam, on the base circle "// &
         & degrees(model%linkage%base_angle), body)
      call add_arc(1.12_wp*model%linkage%b, min(pad, roller), max(pad, roller), "roller_arm_angle "// &
         & degrees(case%mechanism%roller_arm_angle), body)
   end subroutine draw_angles

   !> An arc about the pivot with words at its middle.
   subroutine add_arc(radius, first, last, words, body)
      !> Radius [m]
      real(wp), intent(in) :: radius
      !> Ends, against the clock from the right [rad]
      real(wp), intent(in) :: first, last
      character(len=*), intent(in) :: words
      !> Drawing so far
      character(len=:), allocatable, intent(inout) :: body

      body = body//'<path fill="none" stroke="'//angle_colour//'" stroke-width="1.5" d="M '//pair(polar(radius, first))//' A '// &
         & fixed_text(scale*radius, 1)//" "//fixed_text(scale*radius, 1)//" 0 0 0 "//pair(polar(radius, last))//'"/>'//n
      call add_text(polar(radius + 8.0e-4_wp, 0.5_wp*(first + last)), words, angle_colour, body)
   end subroutine add_arc

   !> Frame, title and legend around a drawing.
   subroutine put_in_frame(case, body, low, high, drawing)
      type(case_t), intent(in) :: case
      !> The drawing without its frame
      character(len=*), intent(in) :: body
      !> Lower left and upper right corner of what is drawn [m]
      real(wp), intent(in) :: low(2), high(2)
      !> The whole
      character(len=:), allocatable, intent(out) :: drawing

      ! Left and upper edge, width and height [unit]
      real(wp) :: left, top, width, height
      character(len=:), allocatable :: legend
      integer :: lines

      legend = ""
      lines = 0
      associate (m => case%mechanism)
         call add_length("pivot_to_roller_mm", m%pivot_to_roller)
         call add_length("pivot_to_pad_mm", m%pivot_to_pad)
         call add_length("pivot_to_cam_mm", m%pivot_to_cam)
         call add_length("base_radius_mm", m%base_radius)
         call add_length("roller.radius_mm", m%roller_radius)
         call add_length("contact_width_mm", m%contact_width)
      end associate
      left = scale*low(1) - margin
      top = -scale*high(2) - margin
      width = max(scale*(high(1) - low(1)) + 2.0_wp*margin, 560.0_wp)
      height = scale*(high(2) - low(2)) + 2.0_wp*margin + line_height*(lines/2 + 1)
      drawing = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="'//fixed_text(left, 1)//" "//fixed_text(top, 1)//" "// &
         & fixed_text(width, 1)//" "//fixed_text(height, 1)//'" font-family="sans-serif" font-size="'// &
         & fixed_text(letters, 1)//'">'//trim(drawing_kind%mark)//n//'<rect x="'//fixed_text(left, 1)//'" y="'// &
         & fixed_text(top, 1)//'" width="100%" height="100%" fill="white"/>'//n//'<text x="'// &
         & fixed_text(left + 20.0_wp, 1)//'" y="'//fixed_text(top + 30.0_wp, 1)//'" font-weight="bold">'// &
         & xml_text(case%title)//'</text>'//n//body//legend
      call add_bar(left + width - 30.0_wp)
      drawing = drawing//'</svg>'//n

   contains

      !> A line of the legend: two columns below the drawing.
      subroutine add_length(name, length)
         !> Name of the key
         character(len=*), intent(in) :: name
         !> Its value [m]
         real(wp), intent(in) :: length

         legend = legend//'<text x="'//fixed_text(scale*low(1) - margin + 20.0_wp + 270.0_wp*modulo(lines, 2), 1)//'" y="'// &
            & fixed_text(-scale*low(2) + margin + line_height*(lines/2), 1)//'" fill="'//grey//'">'//name//" = "// &
            & number_text(1.0e3_wp*length, 5)//"</text>"//n
         lines = lines + 1
      end subroutine add_length

      !> A bar of ten millimetres.
      subroutine add_bar(right)
         !> Its right end [unit]
         real(wp), intent(in) :: right

         drawing = drawing//'<path stroke="black" stroke-width="2" d="M '//fixed_text(right, 1)//" "// &
            & fixed_text(top + 40.0_wp, 1)//" h -"// &
            & fixed_text(1.0e-2_wp*scale, 1)//'"/>'//n//'<text text-anchor="end" x="'//fixed_text(right, 1)//'" y="'// &
            & fixed_text(top + 32.0_wp, 1)//'">10 mm</text>'//n
      end subroutine add_bar

   end subroutine put_in_frame

   !> A circle.
   subroutine add_circle(centre, radius, style, body)
      !> Centre and radius [m]
      real(wp), intent(in) :: centre(2), radius
      character(len=*), intent(in) :: style
      !> Drawing so far
      character(len=:), allocatable, intent(inout) :: body

      body = body//'<circle cx="'//fixed_text(scale*centre(1), 1)//'" cy="'//fixed_text(-scale*centre(2), 1)//'" r="'// &
         & fixed_text(scale*radius, 1)//'" '//style//'/>'//n
   end subroutine add_circle

   !> A line.
   subroutine add_line(from, to, style, body)
      !> Its ends [m]
      real(wp), intent(in) :: from(2), to(2)
      character(len=*), intent(in) :: style
      !> Drawing so far
      character(len=:), allocatable, intent(inout) :: body

      body = body//'<path '//style//' d="M '//pair(from)//" L "//pair(to)//'"/>'//n
   end subroutine add_line

   !> Words.
   subroutine add_text(place, words, colour, body)
      !> Place of their left end [m]
      real(wp), intent(in) :: place(2)
      !> The words and their colour
      character(len=*), intent(in) :: words, colour
      !> Drawing so far
      character(len=:), allocatable, intent(inout) :: body

      body = body//'<text x="'//fixed_text(scale*place(1), 1)//'" y="'//fixed_text(-scale*place(2), 1)//'" fill="'//colour//'">'// &
         & xml_text(words)//'</text>'//n
   end subroutine add_text

   !> A point in the drawing, whose second coordinate grows downwards.
   pure function pair(point) result(text)
      !> The point [m]
      real(wp), intent(in) :: point(2)
      !> Its coordinates
      character(len=:), allocatable :: text

      text = fixed_text(scale*point(1), 1)//" "//fixed_text(-scale*point(2), 1)
   end function pair

   !> An angle in words.
   pure function degrees(angle) result(words)
      !> The angle [rad]
      real(wp), intent(in) :: angle
      !> The words
      character(len=:), allocatable :: words

      words = number_text(angle/degree, 4)//" deg"
   end function degrees

end module camroller_sketch
