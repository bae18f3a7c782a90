! Meshes a tetrahedron given by arrays, from Fortran.
program mesh_arrays
  use, intrinsic :: iso_c_binding
  implicit none
  interface
    integer(c_int) function ccdt_surface_new(vertices, vertex_count, triangles, triangle_count, markers, surface) bind(c)
      import
      real(c_double), intent(in) :: vertices(3, *)
      integer(c_size_t), value :: vertex_count, triangle_count
      integer(c_int32_t), intent(in) :: triangles(3, *)
      type(c_ptr), value :: markers
      type(c_ptr), intent(out) :: surface
    end function
    integer(c_int) function ccdt_mesh_make(surface, options, mesh) bind(c)
      import
      type(c_ptr), value :: surface, options
      type(c_ptr), intent(out) :: mesh
    end function
    integer(c_int) function ccdt_mesh_tetrahedra(mesh, corners, count) bind(c)
      import
      type(c_ptr), value :: mesh
      type(c_ptr), intent(out) :: corners
      integer(c_size_t), intent(out) :: count
    end function
  end interface
  real(c_double) :: vertices(3, 4) = reshape([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1], [3, 4])
  integer(c_int32_t) :: triangles(3, 4) = reshape([0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3], [3, 4])
  integer(c_int32_t), pointer :: corners(:, :)
  type(c_ptr) :: surface, mesh, list
  integer(c_size_t) :: count

  if (ccdt_surface_new(vertices, 4_c_size_t, triangles, 4_c_size_t, c_null_ptr, surface) /= 0) stop 1
  if (ccdt_mesh_make(surface, c_null_ptr, mesh) /= 0) stop 1
  if (ccdt_mesh_tetrahedra(mesh, list, count) /= 0) stop 1
  call c_f_pointer(list, corners, [4_c_size_t, count])
  print '(i0, a, i0)', count, ' tetrahedra, the largest corner is ', maxval(corners)
end program
