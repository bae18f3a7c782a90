#ifndef CCDT_H
#define CCDT_H

/**
 * \file
 * The mesh engine for C, and for languages that call C.
 *
 * Every function returns a status; results come through the last arguments, and are not changed if it is not
 * CCDT_DONE. What a handle returns, arrays and texts, is owned by the handle: it lives until the handle is freed. A
 * function may be called from several threads at once; but while one changes a handle, no other may use it.
 */

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** What became of a call. The first five are the exit codes of the program. */
typedef enum ccdt_status {
  CCDT_DONE = 0,
  CCDT_NO_MESH = 1,       /**< no valid mesh was found */
  CCDT_BAD_CALL = 2,      /**< a pointer is null */
  CCDT_BAD_INPUT = 3,     /**< an input is not valid, an option is out of range, or a file cannot be read or written */
  CCDT_LIMIT_REACHED = 4, /**< of memory, tetrahedra or subdivision */
  CCDT_CANCELED = 5,      /**< the flag of the options was set */
  CCDT_BUG = 6            /**< an error that should not happen */
} ccdt_status;

/** Facets that bound a solid or divide it. */
typedef struct ccdt_surface ccdt_surface;
/** Options of meshing. */
typedef struct ccdt_options ccdt_options;
/** A tetrahedral mesh. */
typedef struct ccdt_mesh ccdt_mesh;

/** The version, such as "1.2.3". */
const char* ccdt_version(void);

/* The last error of the calling thread, until its next call that fails. */

/** What is wrong. */
const char* ccdt_error_text(void);
/** What to do next; may be empty. */
const char* ccdt_error_remedy(void);
/** The file that it is in; may be empty. */
const char* ccdt_error_file(void);
/** The line in the file, from 1; 0: unknown. */
long long ccdt_error_line(void);
/** Where it is, in the units of the input: three coordinates for each of `count` points. */
const double* ccdt_error_points(size_t* count);
/** Which facets it concerns: `count` numbers from 0. */
const long long* ccdt_error_facets(size_t* count);

/** Reads a surface or a piecewise linear complex: .stl .off .obj .ply .poly .smesh .node .mesh .meshb .msh .vtu .vtp */
ccdt_status ccdt_surface_read(const char* file, ccdt_surface** surface);
/**
 * Makes a surface. Without holes and regions, what an odd number of shells separates from infinity is inside; with
 * them, all that cannot be reached from infinity or a hole.
 *
 * \param vertices   three coordinates for each, in any units
 * \param triangles  three indices of vertices for each, from 0; may be null if there are none
 * \param markers    one for each triangle, or null
 */
ccdt_status ccdt_surface_new(const double* vertices, size_t vertex_count, const uint32_t* triangles,
                             size_t triangle_count, const int* markers, ccdt_surface** surface);
/** Adds a facet with any number of corners, in order around it. */
ccdt_status ccdt_surface_add_polygon(ccdt_surface* surface, const uint32_t* corners, size_t count, int marker);
/** Adds an edge that the mesh must have. */
ccdt_status ccdt_surface_add_segment(ccdt_surface* surface, uint32_t a, uint32_t b, int marker);
/** What is around this point stays empty. */
ccdt_status ccdt_surface_add_hole(ccdt_surface* surface, const double point[3]);
/** The tetrahedra around this point get this number. \param largest_volume  of a tetrahedron; 0: any */
ccdt_status ccdt_surface_add_region(ccdt_surface* surface, const double point[3], int number, double largest_volume);
/** Can it be meshed? If not, the last error says why. */
ccdt_status ccdt_surface_check(const ccdt_surface* surface);
/**
 * Repairs a surface as far as possible without knowing what was meant.
 *
 * \param gap    width of the widest gap to close, in the units of the input; 0: the default
 * \param limit  how far lids may reach and everything else may move; 0: the default
 */
ccdt_status ccdt_surface_repair(const ccdt_surface* surface, double gap, double limit, ccdt_surface** repaired);
/** Writes .stl .off .obj .ply .poly .smesh .mesh .meshb; completely or not at all. */
ccdt_status ccdt_surface_write(const ccdt_surface* surface, const char* file);
/** \param coordinates  gets three for each of `count` vertices */
ccdt_status ccdt_surface_vertices(const ccdt_surface* surface, const double** coordinates, size_t* count);
/** \param corners  gets three for each of `count` triangles */
ccdt_status ccdt_surface_triangles(const ccdt_surface* surface, const uint32_t** corners, size_t* count);
void ccdt_surface_free(ccdt_surface* surface);

ccdt_status ccdt_options_new(ccdt_options** options);
/** Sets an option as on the command line: ("edge-length", "2.5"), ("surface", "refine"), ("sizes", "part.sol"). */
ccdt_status ccdt_options_set(ccdt_options* options, const char* name, const char* value);
/**
 * Edges are at most as long as a function says. It is called from any thread, and by several at once unless the option
 * "threads" is 1.
 *
 * \param function  gets three coordinates for each of `count` points, and fills in `count` lengths
 * \param data      is passed to it
 */
ccdt_status ccdt_options_set_size_function(ccdt_options* options,
                                           void (*function)(const double* points, size_t count, double* lengths,
                                                            void* data),
                                           void* data);
/** Work with these options ends soon after another thread sets this flag to anything but 0. Null: no flag. */
ccdt_status ccdt_options_set_cancel_flag(ccdt_options* options, const int* flag);
void ccdt_options_free(ccdt_options* options);

/** Fills a surface with tetrahedra. \param options  null: the defaults */
ccdt_status ccdt_mesh_make(const ccdt_surface* surface, const ccdt_options* options, ccdt_mesh** mesh);
/** Reads a mesh that any mesher wrote: .vtu .msh .mesh .meshb .node */
ccdt_status ccdt_mesh_read(const char* file, ccdt_mesh** mesh);
/** Improves a mesh; its faces, boundary, regions and edges stay. \param options  null: the defaults */
ccdt_status ccdt_mesh_improve(const ccdt_mesh* mesh, const ccdt_options* options, ccdt_mesh** better);
/** Writes .vtu .msh .msh4 .mesh .meshb .inp .xdmf .polymesh .node; completely or not at all. */
ccdt_status ccdt_mesh_write(const ccdt_mesh* mesh, const char* file);
/** \param coordinates  gets three for each of `count` vertices, in the units of the input */
ccdt_status ccdt_mesh_vertices(const ccdt_mesh* mesh, const double** coordinates, size_t* count);
/** \param corners  gets four indices of vertices for each of `count` tetrahedra, from 0 */
ccdt_status ccdt_mesh_tetrahedra(const ccdt_mesh* mesh, const uint32_t** corners, size_t* count);
/** \param numbers  gets the region of each of `count` tetrahedra */
ccdt_status ccdt_mesh_regions(const ccdt_mesh* mesh, const int** numbers, size_t* count);
/** \param corners  gets three for each of `count` faces on facets: the boundary, and interior facets */
ccdt_status ccdt_mesh_faces(const ccdt_mesh* mesh, const uint32_t** corners, size_t* count);
/** \param markers  gets one for each face; `count` is 0 if they are unknown */
ccdt_status ccdt_mesh_face_markers(const ccdt_mesh* mesh, const int** markers, size_t* count);
/** \param ends  gets two for each of `count` edges on segments */
ccdt_status ccdt_mesh_edges(const ccdt_mesh* mesh, const uint32_t** ends, size_t* count);
/** \param markers  gets one for each edge */
ccdt_status ccdt_mesh_edge_markers(const ccdt_mesh* mesh, const int** markers, size_t* count);
void ccdt_mesh_free(ccdt_mesh* mesh);

#ifdef __cplusplus
}
#endif

#endif
