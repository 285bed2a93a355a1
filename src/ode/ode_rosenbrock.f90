!> A Rosenbrock method: its coefficients, and the procedure that makes a step with them.
!>
!> In: number of components. Out: a `method_t`. Each stage solves one linear system with the matrix `I/(gamma h) - J`; there is
!> no iteration. With the increments u_i a stage is
!>
!>     (I/(gamma h) - J) u_i = f(t + c_i h, y + sum a_ij u_j) + sum C_ij u_j/h + h d_i df/dt
!>
!> The method is L-stable and stiffly accurate: the last increment is also the error estimate, and the trial state of the last
!> stage plus that increment is the new state. Dense output is a combination of the increments, not of the rates at both ends,
!> which would lose accuracy on stiff problems. Source of form and dense output: Hairer and Wanner, Solving Ordinary Differential
!> Equations II, 2nd ed., Springer (1996), section IV.7 and chapter VI.4.
!>
!> | method | order | stages | source |
!> |---|---|---|---|
!> | `rodas5p` | 5(4) | 8, no loss of order on stiff smooth solutions | Steinebach, BIT Numer. Math. 63 (2023) 27 |
module camroller_ode_rosenbrock
   use camroller_kinds, only : wp
   use camroller_ode, only : problem_t, method_t, step_t, counters_t
   use camroller_ode_problem, only : factors_t, new_factors
   implicit none
   private

   public :: rosenbrock_method_t, new_rosenbrock_method

   !> Most stages of a table
   integer, parameter :: most_stages = 8

   !> A Rosenbrock method: its table and its work space
   type, extends(method_t) :: rosenbrock_method_t
      !> Number of stages
      integer :: stages = 0
      !> Diagonal coefficient, gamma [-]
      real(wp) :: diagonal = 0.0_wp
      !> Times of the stages, c [-]
      real(wp), allocatable :: nodes(:)
      !> Weights of df/dt in the stages, d [-]
      real(wp), allocatable :: slope_weights(:)
      !> Weights of the increments (row) in the trial state of a stage (column), a [-]
      real(wp), allocatable :: weights(:, :)
      !> Weights of the increments (row) on the right-hand side of a stage (column), C [-]
      real(wp), allocatable :: couplings(:, :)
      !> Weights of the increments (row) in the bends of the curve (column) [-]
      real(wp), allocatable :: bend_weights(:, :)
      !> Increments of the stages, shape (component, stage) [state]
      real(wp), allocatable :: increments(:, :)
      !> Factors of the matrix of the stages
      type(factors_t) :: factors
      !> Rate at a trial state [state/time]
      real(wp), allocatable :: stage_rate(:)
   contains
      procedure :: try_step => try_rosenbrock_step
   end type rosenbrock_method_t

contains

   !> Make the method.
   subroutine new_rosenbrock_method(method, components)
      !> The method
      type(rosenbrock_method_t), intent(out) :: method
      !> Number of components of the state
      integer, intent(in) :: components

      call set_rodas5p(method)
      method%gives_rate = .false.
      method%needs_jacobian = .true.
      method%proportional = 1.0_wp
      method%integral = 0.0_wp
      method%has_curve = .true.
      allocate (method%increments(components, method%stages), method%bends(components, 3))
      allocate (method%stage_rate(components))
      call new_factors(method%factors, components)
   end subroutine new_rosenbrock_method

   !> Room for a table, filled with zeros.
   subroutine clear_table(method, stages)
      type(rosenbrock_method_t), intent(inout) :: method
      !> Number of stages
      integer, intent(in) :: stages

      method%stages = stages
      allocate (method%nodes(stages), method%slope_weights(stages), method%weights(stages, stages), &
         & method%couplings(stages, stages), method%bend_weights(stages, 3))
      method%nodes = 0.0_wp
      method%slope_weights = 0.0_wp
      method%weights = 0.0_wp
      method%couplings = 0.0_wp
      method%bend_weights = 0.0_wp
   end subroutine clear_table

   !> Steinebach (2023).
   subroutine set_rodas5p(method)
      type(rosenbrock_method_t), intent(inout) :: method

      call clear_table(method, most_stages)
      method%error_order = 5
      method%diagonal = 0.21193756319429014_wp
      method%nodes = [0.0_wp, 0.6358126895828704_wp, 0.4095798393397535_wp, 0.9769306725060716_wp, 0.4288403609558664_wp, &
         & 1.0_wp, 1.0_wp, 1.0_wp]
      method%slope_weights(:5) = [0.21193756319429014_wp, -0.42387512638858027_wp, -0.3384627126235924_wp, &
         & 1.8046452872882734_wp, 2.325825639765069_wp]
      method%weights(:1, 2) = [3.0_wp]
      method%weights(:2, 3) = [2.849394379747939_wp, 0.45842242204463923_wp]
      method%weights(:3, 4) = [-6.954028509809101_wp, 2.489845061869568_wp, -10.358996098473584_wp]
      method%weights(:4, 5) = [2.8029986275628964_wp, 0.5072464736228206_wp, -0.3988312541770524_wp, &
         & -0.04721187230404641_wp]
      method%weights(:5, 6) = [-7.502846399306121_wp, 2.561846144803919_wp, -11.627539656261098_wp, &
         & -0.18268767659942256_wp, 0.030198172008377946_wp]
      method%weights(:6, 7) = [method%weights(:5, 6), 1.0_wp]
      method%weights(:7, 8) = [method%weights(:6, 7), 1.0_wp]
      method%couplings(:1, 2) = [-14.155112264123755_wp]
      method%couplings(:2, 3) = [-17.97296035885952_wp, -2.859693295451294_wp]
      method%couplings(:3, 4) = [147.12150275711716_wp, -1.41221402718213_wp, 71.68940251302358_wp]
      method%couplings(:4, 5) = [165.43517024871676_wp, -0.4592823456491126_wp, 42.90938336958603_wp, &
         & -5.961986721573306_wp]
      method%couplings(:5, 6) = [24.854864614690072_wp, -3.0009227002832186_wp, 47.4931110020768_wp, &
         & 5.5814197821558125_wp, -0.6610691825249471_wp]
      method%couplings(:6, 7) = [30.91273214028599_wp, -3.1208243349937974_wp, 77.79954646070892_wp, &
         & 34.28646028294783_wp, -19.097331116725623_wp, -28.087943162872662_wp]
      method%couplings(:7, 8) = [37.80277123390563_wp, -3.2571969029072276_wp, 112.26918849496327_wp, &
         & 66.9347231244047_wp, -40.06618937091002_wp, -54.66780262877968_wp, -9.48861652309627_wp]
      method%bend_weights(:, 1) = [25.948786856663858_wp, -2.5579724845846235_wp, 10.433815404888879_wp, &
         & -2.3679251022685204_wp, 0.524948541321073_wp, 1.1241088310450404_wp, 0.4272876194431874_wp, &
         & -0.17202221070155493_wp]
      method%bend_weights(:, 2) = [-9.91568850695171_wp, -0.9689944594115154_wp, 3.0438037242978453_wp, &
         & -24.495224566215796_wp, 20.176138334709044_wp, 15.98066361424651_wp, -6.789040303419874_wp, &
         & -6.710236069923372_wp]
      method%bend_weights(:, 3) = [11.419903575922262_wp, 2.8879645146136994_wp, 72.92137995996029_wp, &
         & 80.12511834622643_wp, -52.072871366152654_wp, -59.78993625266729_wp, -0.15582684282751913_wp, &
         & 4.883087185713722_wp]
   end subroutine set_rodas5p

   !> One step of a Rosenbrock method.
   subroutine try_rosenbrock_step(self, problem, step, counters, status)
      !> The method with its work space and the Jacobian at this point
      class(rosenbrock_method_t), intent(inout) :: self
      class(problem_t), intent(in) :: problem
      type(step_t), intent(inout) :: step
      !> Work done so far
      type(counters_t), intent(inout) :: counters
      !> 0 fine, positive: try a smaller step, negative: give up
      integer, intent(out) :: status

      ! Factors of the increments on the right-hand side [1/time]
      real(wp) :: factors(most_stages)
      integer :: stage, i, n

      n = size(step%state)
      associate (new_state => step%new_state, length => step%length)
         new_state(:) = step%state
         step%new_rate(:) = 0.0_wp
         step%estimate(:) = 0.0_wp
         self%stage_rate(:) = step%rate
         call problem%factorise(self%here, 1.0_wp/(self%diagonal*length), self%factors, status)
         counters%factorisations = counters%factorisations + 1
         if (status /= 0) return
         do stage = 1, self%stages
            if (stage > self%stages - 2) then
               ! The last two stages begin where the one before has ended
               new_state(:) = new_state + self%increments(:, stage - 1)
            else
               call add_multiples(n, stage - 1, self%weights(:, stage), self%increments, 1.0_wp, step%state, new_state)
            end if
            if (stage > 1) then
               call problem%get_rate(step%time + length*self%nodes(stage), new_state, self%stage_rate, status)
               counters%evaluations = counters%evaluations + 1
               if (status /= 0) return
            end if
            factors(:stage - 1) = self%couplings(:stage - 1, stage)/length
            call add_multiples(n, stage - 1, factors, self%increments, 1.0_wp, self%stage_rate, self%increments(:, stage))
            if (abs(self%slope_weights(stage)) > 0.0_wp) self%increments(:, stage) = self%increments(:, stage) &
               & + (length*self%slope_weights(stage))*self%here%time_slope
            call problem%solve(self%here, self%factors, self%increments(:, stage))
         end do
         step%estimate(:) = self%increments(:, self%stages)
         new_state(:) = new_state + step%estimate
      end associate
      do i = 1, 3
         call add_multiples(n, self%stages - 1, self%bend_weights(2:, i), self%increments(:, 2:), self%bend_weights(1, i), &
            & self%increments(:, 1), self%bends(:, i))
      end do
   end subroutine try_rosenbrock_step

   !> Sum of multiples of vectors, up to three first and then by fours, which spares reading and writing the sum.
   pure subroutine add_multiples(components, count, factors, addends, first_factor, first, total)
      !> Number of components, of vectors beside the first
      integer, intent(in) :: components, count
      !> Factors [any]
      real(wp), intent(in) :: factors(count)
      !> Vectors, shape (component, vector) [any]
      real(wp), intent(in) :: addends(components, count)
      !> Another factor [any], and its vector [any]
      real(wp), intent(in) :: first_factor, first(components)
      !> The sum [any]
      real(wp), intent(out) :: total(components)

      integer :: i

      select case (modulo(count, 4))
      case (0)
         total = first_factor*first
      case (1)
         total = first_factor*first + factors(1)*addends(:, 1)
      case (2)
         total = first_factor*first + factors(1)*addends(:, 1) + factors(2)*addends(:, 2)
      case default
         total = first_factor*first + factors(1)*addends(:, 1) + factors(2)*addends(:, 2) + factors(3)*addends(:, 3)
      end select
      do i = modulo(count, 4) + 1, count, 4
         total = total + factors(i)*addends(:, i) + factors(i + 1)*addends(:, i + 1) + factors(i + 2)*addends(:, i + 2) &
            & + factors(i + 3)*addends(:, i + 3)
      end do
   end subroutine add_multiples

end module camroller_ode_rosenbrock
