!> Oil as a data sheet describes it: viscosity index, SAE grade, and an estimate of the pressure-viscosity coefficient.
!>
!> In: kinematic viscosities, an index, a grade. Out: what the viscosity laws take.
!> Sources: ASTM D2270 (viscosity index, equations for its table); SAE J300 (grades); So and Klaus (1980), Viscosity-pressure
!> correlation of liquids, ASLE Transactions 23, 409.
module camroller_oil_data
   use camroller_kinds, only : wp
   use camroller_names, only : name_length
   implicit none
   private

   public :: sae_grade_names, grade_viscosity, grade_index, viscosity_at_40, reference_viscosities, so_klaus_coefficient
   public :: smallest_indexed, smallest_estimated

   !> SAE grades that can be chosen by name
   character(len=*), parameter :: sae_grade_names(*) = [character(len=name_length) :: "none", "20", "30", "40", "50", "60", &
      & "0W-16", "0W-20", "5W-20", "0W-30", "5W-30", "10W-30", "0W-40", "5W-40", "10W-40", "15W-40", "20W-50"]
   !> Kinematic viscosity at 100 degC: the middle of the range of SAE J300 [mm^2/s]
   real(wp), parameter :: grade_viscosity(*) = [0.0_wp, 8.1_wp, 10.9_wp, 14.4_wp, 19.1_wp, 24.0_wp, 7.15_wp, 8.1_wp, 8.1_wp, &
      & 10.9_wp, 10.9_wp, 10.9_wp, 14.4_wp, 14.4_wp, 14.4_wp, 14.4_wp, 19.1_wp]
   !> Viscosity index assumed: 100 for a single grade; for two, what data sheets of such oils give [-]
   real(wp), parameter :: grade_index(*) = [0.0_wp, 100.0_wp, 100.0_wp, 100.0_wp, 100.0_wp, 100.0_wp, 170.0_wp, 170.0_wp, &
      & 155.0_wp, 170.0_wp, 160.0_wp, 145.0_wp, 175.0_wp, 165.0_wp, 150.0_wp, 135.0_wp, 125.0_wp]

   !> Smallest viscosity at 100 degC for which the index is defined [mm^2/s]
   real(wp), parameter :: smallest_indexed = 2.0_wp
   !> Smallest kinematic viscosity for the estimate of So and Klaus: below, its powers vanish [mm^2/s]
   real(wp), parameter :: smallest_estimated = 2.0_wp

   !> Lower ends of the intervals of viscosity at 100 degC in ASTM D2270 [mm^2/s]
   real(wp), parameter :: intervals(*) = [2.0_wp, 3.8_wp, 4.4_wp, 5.0_wp, 6.4_wp, 7.0_wp, 7.7_wp, 9.0_wp, 12.0_wp, 15.0_wp, &
      & 18.0_wp, 22.0_wp, 28.0_wp, 40.0_wp, 55.0_wp, 70.0_wp]
   !> Coefficients of `a Y^2 + b Y + c`, the viscosity at 40 degC of an oil of index 0 (first three) and of index 100 (last
   !> three), for each interval [s/mm^2, -, mm^2/s]
   real(wp), parameter :: index_coefficients(6, size(intervals)) = reshape([ &
      1.14673_wp, 1.7576_wp, -0.109_wp, 0.84155_wp, 1.5521_wp, -0.077_wp, &
      3.38095_wp, -15.4952_wp, 33.196_wp, 0.78571_wp, 1.7929_wp, -0.183_wp, &
      2.5_wp, -7.2143_wp, 13.812_wp, 0.82143_wp, 1.5679_wp, 0.119_wp, &
      0.101_wp, 16.635_wp, -45.469_wp, 0.04985_wp, 9.1613_wp, -18.557_wp, &
      3.35714_wp, -23.5643_wp, 78.466_wp, 0.22619_wp, 7.7369_wp, -16.656_wp, &
      0.01191_wp, 21.475_wp, -72.870_wp, 0.79762_wp, -0.7321_wp, 14.610_wp, &
      0.41858_wp, 16.1558_wp, -56.040_wp, 0.05794_wp, 10.5156_wp, -28.240_wp, &
      0.88779_wp, 7.5527_wp, -16.600_wp, 0.26665_wp, 6.7015_wp, -10.810_wp, &
      0.76720_wp, 10.7972_wp, -38.180_wp, 0.20073_wp, 8.4658_wp, -22.490_wp, &
      0.97305_wp, 5.3135_wp, -2.200_wp, 0.28889_wp, 5.9741_wp, -4.930_wp, &
      0.97256_wp, 5.2500_wp, -0.980_wp, 0.24504_wp, 7.4160_wp, -16.730_wp, &
      0.91413_wp, 7.4759_wp, -21.820_wp, 0.20323_wp, 9.1267_wp, -34.230_wp, &
      0.87031_wp, 9.7157_wp, -50.770_wp, 0.18411_wp, 10.1015_wp, -46.750_wp, &
      0.84703_wp, 12.6752_wp, -133.310_wp, 0.17029_wp, 11.4866_wp, -80.620_wp, &
      0.85921_wp, 11.1009_wp, -83.190_wp, 0.17130_wp, 11.3680_wp, -76.940_wp, &
      0.83531_wp, 14.6731_wp, -216.246_wp, 0.16841_wp, 11.8493_wp, -96.947_wp], [6, size(intervals)])

contains

   !> Viscosities at 40 degC of the two reference oils that an index is measured from, with the viscosity of the oil at 100 degC.
   !>
   !> Source: ASTM D2270, equations for its table.
   pure subroutine reference_viscosities(at_100, none, hundred)
      !> Viscosity at 100 degC, 2 or more [mm^2/s]
      real(wp), intent(in) :: at_100
      !> Viscosity at 40 degC of the oil of index 0, L, and of index 100, H [mm^2/s]
      real(wp), intent(out) :: none, hundred

      integer :: i

      i = max(1, count(intervals <= at_100))
      associate (c => index_coefficients(:, i))
         none = (c(1)*at_100 + c(2))*at_100 + c(3)
         hundred = (c(4)*at_100 + c(5))*at_100 + c(6)
      end associate
   end subroutine reference_viscosities

   !> Viscosity at 40 degC from that at 100 degC and the viscosity index.
   !>
   !> Source: ASTM D2270; procedure A up to an index of 100, procedure B above.
   pure function viscosity_at_40(at_100, index) result(at_40)
      !> Viscosity at 100 degC, 2 or more [mm^2/s]
      real(wp), intent(in) :: at_100
      !> Viscosity index [-]
      real(wp), intent(in) :: index
      !> Viscosity at 40 degC [mm^2/s]
      real(wp) :: at_40

      ! Viscosities at 40 degC of the oils of index 0 and 100 [mm^2/s]; exponent of procedure B, and its constant [-]
      real(wp) :: none, hundred, exponent
      real(wp), parameter :: constant = 0.00715_wp

      call reference_viscosities(at_100, none, hundred)
      if (index <= 100.0_wp) then
         at_40 = none - 0.01_wp*index*(none - hundred)
      else
         exponent = log10(1.0_wp + constant*(index - 100.0_wp))
         at_40 = hundred*at_100**(-exponent)
      end if
   end function viscosity_at_40

   !> Pressure-viscosity coefficient estimated from viscosity, its fall with temperature, and density.
   !>
   !> Source: So and Klaus (1980). The slope is that of Walther's law, the slope on the chart of ASTM D341 over 0.2.
   pure function so_klaus_coefficient(viscosity, slope, density) result(coefficient)
      !> Kinematic viscosity at the temperature, `smallest_estimated` or more [mm^2/s]
      real(wp), intent(in) :: viscosity
      !> Slope of log10 log10 (viscosity + 0.7) over log10 of the temperature, its sign changed [-]
      real(wp), intent(in) :: slope
      !> Density at the temperature [kg/m^3]
      real(wp), intent(in) :: density
      !> Pressure-viscosity coefficient [1/Pa]
      real(wp) :: coefficient

      ! Decimal logarithm of the viscosity [-]
      real(wp) :: x

      x = log10(viscosity)
      coefficient = 1.0e-8_wp*(1.216_wp + 4.143_wp*x**3.0627_wp + 2.848e-4_wp*slope**5.1903_wp*x**1.5976_wp &
         & - 3.999_wp*x**3.0975_wp*(1.0e-3_wp*density)**0.1162_wp)
   end function so_klaus_coefficient

end module camroller_oil_data
