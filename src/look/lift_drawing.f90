!> Lift, velocity, acceleration and jerk of a case over the cam angle, as SVG: what a table gives beside what is made of it.
!>
!> In: a case. Out: the text of a drawing. Derivatives of a table are differences of its rows, so that its noise is seen as it is;
!> beside them stand the curve of the case and, where the noise is known, the curve that smoothing by as much would give.
module camroller_lift_drawing
   use camroller_kinds, only : wp, degree, pi
   use camroller_cam_angle, only : file_angle
   use camroller_case, only : case_t
   use camroller_error, only : error_t
   use camroller_lift, only : evaluate_lift, given_table, lift_law_t, lift_t, new_lift_law, stop_angles
   use camroller_lift_noise, only : find_lift_noise, lift_noise_t
   use camroller_number_text, only : fixed_text, number_text
   use camroller_output_kind, only : drawing_kind
   use camroller_quotes, only : xml_text
   implicit none
   private

   public :: draw_lift

   !> Curves of one derivative
   type :: curve_t
      !> Cam angles in the file's count [deg], and values [mm/rad^k]
      real(wp), allocatable :: angle(:), value(:)
      character(len=7) :: colour
      character(len=40) :: words
      !> Width of the line [unit]
      real(wp) :: width = 1.5_wp
   end type curve_t

   !> Edges and size of a panel, distance of panels [unit]
   real(wp), parameter :: left = 90.0_wp, top = 76.0_wp, width = 760.0_wp, height = 150.0_wp, distance = 185.0_wp
   !> Step of the curves [rad]
   real(wp), parameter :: step = 0.25_wp*degree
   !> Part of the largest value of the curves that differences of rows are drawn to [-]
   real(wp), parameter :: beyond = 1.5_wp
   character(len=*), parameter :: n = new_line("a")
   character(len=*), parameter :: quantities(0:3) = [character(len=24) :: "lift [mm]", "velocity [mm/rad]", &
      & "acceleration [mm/rad^2]", "jerk [mm/rad^3]"]

contains

   !> Draw the lifts of a case, one below the other.
   subroutine draw_lift(case, drawing, error)
      !> The case
      type(case_t), intent(in) :: case
      !> The drawing
      character(len=:), allocatable, intent(out) :: drawing
      !> Deck error of a lift
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: body
      ! Height of all lobes [unit]
      real(wp) :: depth

      body = ""
      depth = 0.0_wp
      call add_lobe(case%lift, trim(case%title), depth, body, error)
      if (allocated(error)) return
      if (allocated(case%second_lift)) call add_lobe(case%second_lift, trim(case%title)//", second lobe", depth, body, error)
      if (allocated(error)) return
      drawing = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 '//fixed_text(left + width + 40.0_wp, 0)//" "// &
         & fixed_text(depth, 0)//'" font-family="sans-serif" font-size="14">'//trim(drawing_kind%mark)//n// &
         & '<rect width="100%" height="100%" fill="white"/>'//n//body//"</svg>"//n
   end subroutine draw_lift

   !> Four panels of one lobe.
   subroutine add_lobe(lift, title, depth, body, error)
      type(lift_t), intent(in) :: lift
      character(len=*), intent(in) :: title
      !> Height of the lobes so far [unit]
      real(wp), intent(inout) :: depth
      !> Drawing so far
      character(len=:), allocatable, intent(inout) :: body
      !> Deck error
      type(error_t), allocatable, intent(out) :: error

      type(curve_t), allocatable :: curves(:, :)
      integer :: order

      call find_curves(given_table(lift), curves, error)
      if (allocated(error)) return
      body = body//'<text x="'//fixed_text(left, 0)//'" y="'//fixed_text(depth + 24.0_wp, 0)//'" font-weight="bold">'// &
         & xml_text(title)//trim(merge(", values of its table over their own angle", repeat(" ", 42), &
         & allocated(lift%given_lift)))//"</text>"//n
      call add_legend(curves(:, 0), depth + 46.0_wp, body)
      do order = 0, 3
         call add_panel(curves(:, order), trim(quantities(order)), depth + top + distance*order, body)
      end do
      depth = depth + top + 4.0_wp*distance + 20.0_wp
   end subroutine add_lobe

   !> Curves of a lift and its derivatives: differences of the rows of a table first, the curve of the case last.
   subroutine find_curves(lift, curves, error)
      type(lift_t), intent(in) :: lift
      !> Its curves, for each derivative
      type(curve_t), allocatable, intent(out) :: curves(:, :)
      !> Deck error
      type(error_t), allocatable, intent(out) :: error

      type(lift_noise_t) :: noise
      type(lift_t) :: smoother
      type(lift_law_t) :: law
      real(wp), allocatable :: stops(:) ! [rad]
      real(wp) :: first, last ! [rad]
      integer :: count

      count = 1
      call new_lift_law(law, lift, error)
      if (allocated(error)) return
      stops = [stop_angles(law), pi]
      first = stops(1)
      last = stops(max(1, size(stops) - 1))
      if (allocated(lift%table_angle)) then
         first = lift%table_angle(1)
         last = lift%table_angle(size(lift%table_angle))
         call find_lift_noise(lift, noise)
         count = merge(3, 2, noise%is_known .and. abs(noise%smoothing - lift%smoothing) > 0.0_wp)
      end if
      allocate (curves(count, 0:3))
      if (allocated(lift%table_angle)) then
         call take_differences(lift, curves(1, :))
      end if
      if (count == 3) then
         smoother = lift
         smoother%smoothing = noise%smoothing
         call sample(smoother, first, last, "#e07b00", "smoothing_um = "//number_text(1.0e6_wp*noise%smoothing, 2), &
            & curves(2, :), error)
         if (allocated(error)) return
      end if
      call sample(lift, first, last, "#1f4e8c", "as the case has it", curves(count, :), error)
   end subroutine find_curves

   !> A lift and its derivatives.
   subroutine sample(lift, first, last, colour, words, curves, error)
      type(lift_t), intent(in) :: lift
      !> Ends of the event [rad from full lift]
      real(wp), intent(in) :: first, last
      !> Colour and name of the curve
      character(len=*), intent(in) :: colour, words
      !> Gets the curves
      type(curve_t), intent(inout) :: curves(0:)
      !> Deck error
      type(error_t), allocatable, intent(out) :: error

      type(lift_law_t) :: law
      ! Lift and its derivatives [m, m/rad, ...]
      real(wp) :: values(0:3)
      real(wp), allocatable :: angles(:), all(:, :) ! [rad; mm/rad^k]
      integer :: i, steps

      call new_lift_law(law, lift, error)
      if (allocated(error)) return
      steps = ceiling((last - first)/step)
      allocate (angles(0:steps), all(0:steps, 0:3))
      do i = 0, steps
         angles(i) = first + (last - first)*i/steps
         call evaluate_lift(law, angles(i), values)
         all(i, :) = 1.0e3_wp*values
      end do
      do i = 0, 3
         curves(i)%angle = file_angle(angles)
         curves(i)%value = all(:, i)
         curves(i)%colour = colour
         curves(i)%words = words
      end do
   end subroutine sample

   !> Rows of a lift table, and their divided differences of the orders 1 to 3, each drawn in the middle of the rows that it is made
   !> of.
   subroutine take_differences(lift, curves)
      type(lift_t), intent(in) :: lift
      !> Gets the curves
      type(curve_t), intent(inout) :: curves(0:)

      real(wp), allocatable :: angle(:), value(:) ! [rad; mm/rad^k]
      integer :: order, rows

      angle = lift%table_angle
      value = 1.0e3_wp*lift%table_lift
      do order = 0, 3
         curves(order)%angle = file_angle(angle)
         curves(order)%value = value
         curves(order)%colour = "#aaaaaa"
         curves(order)%words = "differences of the table's rows"
         curves(order)%width = 1.0_wp
         rows = size(value)
         if (rows < 2) exit
         value = (value(2:) - value(:rows - 1))/(angle(2:) - angle(:rows - 1))
         angle = 0.5_wp*(angle(2:) + angle(:rows - 1))
      end do
   end subroutine take_differences

   !> Names of the curves in their colours.
   subroutine add_legend(curves, place, body)
      type(curve_t), intent(in) :: curves(:)
      !> Height [unit]
      real(wp), intent(in) :: place
      !> Drawing so far
      character(len=:), allocatable, intent(inout) :: body

      integer :: i

      do i = 1, size(curves)
         body = body//'<text x="'//fixed_text(left + 250.0_wp*(i - 1), 0)//'" y="'//fixed_text(place, 0)//'" fill="'// &
            & curves(i)%colour//'">'//xml_text(trim(curves(i)%words))//"</text>"//n
      end do
   end subroutine add_legend

   !> One derivative over the cam angle: a frame, its scale, the curves.
   subroutine add_panel(curves, words, place, body)
      type(curve_t), intent(in) :: curves(:)
      !> What is drawn
      character(len=*), intent(in) :: words
      !> Upper edge [unit]
      real(wp), intent(in) :: place
      !> Drawing so far
      character(len=:), allocatable, intent(inout) :: body

      ! Ends of both scales, smallest and largest value of the case's curve [deg; mm/rad^k]
      real(wp) :: across(2), range(2), ends(2)
      integer :: i, j, k

      associate (last => curves(size(curves)))
         across = [last%angle(1), last%angle(size(last%angle))]
         ends = [minval(last%value), maxval(last%value)]
      end associate
      range = ends + 0.5_wp*(beyond - 1.0_wp)*(ends(2) - ends(1))*[-1.0_wp, 1.0_wp]
      body = body//'<rect x="'//fixed_text(left, 1)//'" y="'//fixed_text(place, 1)//'" width="'//fixed_text(width, 1)// &
         & '" height="'//fixed_text(height, 1)//'" fill="none" stroke="#666666"/>'//n
      call add_words(left, place - 4.0_wp, "start", words)
      do i = 0, 4
         call add_words(left + 0.25_wp*i*width, place + height + 16.0_wp, "middle", &
            & fixed_text(across(1) + 0.25_wp*i*(across(2) - across(1)), 1)//trim(merge(" deg", "    ", i == 4)))
      end do
      call add_words(left - 6.0_wp, level(0.0_wp) + 5.0_wp, "end", "0")
      do i = 1, 2
         if (abs(ends(i)) > 0.1_wp*(ends(2) - ends(1))) call add_words(left - 6.0_wp, level(ends(i)) + 5.0_wp, "end", &
            & number_text(ends(i), 3))
      end do
      if (product(range) < 0.0_wp) body = body//'<path stroke="#cccccc" d="M '//pair(across(1), 0.0_wp)//" L "// &
         & pair(across(2), 0.0_wp)//'"/>'//n
      do i = 1, size(curves)
         ! the case's curve behind the smoother one, which it would hide
         k = i
         if (size(curves) == 3 .and. i > 1) k = 5 - i
         body = body//'<path fill="none" stroke="'//curves(k)%colour//'" stroke-width="'//fixed_text(curves(k)%width, 1)//'" d="M'
         do j = 1, size(curves(k)%value)
            body = body//" "//pair(curves(k)%angle(j), curves(k)%value(j))
         end do
         body = body//'"/>'//n
      end do

   contains

      !> A point; beyond the frame on its edge.
      function pair(angle, value) result(text)
         !> Cam angle [deg]; value [mm/rad^k]
         real(wp), intent(in) :: angle, value
         character(len=24) :: text

         text = fixed_text(left + width*(angle - across(1))/(across(2) - across(1)), 1)//" "//fixed_text(level(value), 1)
      end function pair

      !> Height of a value; beyond the frame its edge.
      pure function level(value)
         !> The value [mm/rad^k]
         real(wp), intent(in) :: value
         !> Its height [unit]
         real(wp) :: level

         level = place + height*(1.0_wp - min(1.0_wp, max(0.0_wp, (value - range(1))/(range(2) - range(1)))))
      end function level

      !> Words beside the frame.
      subroutine add_words(x, y, anchor, what)
         !> Place [unit]
         real(wp), intent(in) :: x, y
         !> Which part of the words stands there, and the words
         character(len=*), intent(in) :: anchor, what

         body = body//'<text x="'//fixed_text(x, 1)//'" y="'//fixed_text(y, 1)//'" text-anchor="'//anchor//'" fill="#333333">'// &
            & xml_text(what)//"</text>"//n
      end subroutine add_words

   end subroutine add_panel

end module camroller_lift_drawing
