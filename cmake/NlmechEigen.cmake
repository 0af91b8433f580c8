# Eigen's products and decompositions of matrices of doubles, compiled once, into nlmech::support, instead of once a source that
# uses them. The precompiled headers declare them (NLMECH_EIGEN_HEADERS); a source that includes Eigen alone instantiates its
# own, with the same results. Included where components begin that need Eigen.
nlmech_require(Eigen Eigen3 libeigen3-dev CONFIG)

set(generated ${PROJECT_BINARY_DIR}/generated/dense)
set(sources "")
set(headers <Eigen/Dense>)

# Instances of one kind, in namespace Eigen: a source that makes them and a header that declares them.
#   nlmech_eigen_instances(decompositions "class FullPivLU<MatrixXd>")
function(nlmech_eigen_instances kind)
  list(TRANSFORM ARGN PREPEND "template " OUTPUT_VARIABLE made)
  list(TRANSFORM ARGN PREPEND "extern template " OUTPUT_VARIABLE declared)
  foreach(lines IN ITEMS made declared)
    list(JOIN ${lines} ";\n" ${lines})
    set(${lines} "#include <Eigen/Dense>\nnamespace Eigen {\n${${lines}};\n}\n")
  endforeach()
  file(CONFIGURE OUTPUT ${generated}/${kind}.cpp CONTENT "${made}" @ONLY)
  file(CONFIGURE OUTPUT ${generated}/${kind}.hpp CONTENT "#pragma once\n${declared}" @ONLY)
  set(sources ${sources} ${generated}/${kind}.cpp PARENT_SCOPE)
  set(headers ${headers} ${generated}/${kind}.hpp PARENT_SCOPE)
endfunction()

# What products and solutions with triangles end in: the names are those of Eigen 3.4, and no promise of another.
if(Eigen3_VERSION VERSION_GREATER_EQUAL 3.4 AND Eigen3_VERSION VERSION_LESS 3.4.90)
  set(by_rows "internal::const_blas_data_mapper<double, Index, RowMajor>")
  set(by_columns "internal::const_blas_data_mapper<double, Index, ColMajor>")
  set(product "struct internal::general_matrix_matrix_product<Index, double")
  set(times_vector "struct internal::general_matrix_vector_product<Index, double")
  nlmech_eigen_instances(products
    "struct internal::gebp_kernel<double, double, Index, internal::blas_data_mapper<double, Index, ColMajor, Unaligned, 1>, 4, 4, false, false>"
    "${product}, ColMajor, false, double, ColMajor, false, ColMajor, 1>"
    "${product}, ColMajor, false, double, RowMajor, false, ColMajor, 1>"
    "${product}, RowMajor, false, double, ColMajor, false, ColMajor, 1>"
    "${times_vector}, ${by_rows}, RowMajor, false, double, ${by_columns}, false, 0>"
    "${times_vector}, ${by_rows}, RowMajor, false, double, ${by_rows}, false, 1>"
    "${times_vector}, ${by_columns}, ColMajor, false, double, ${by_rows}, false, 0>"
    "${times_vector}, ${by_columns}, ColMajor, false, double, ${by_columns}, false, 0>"
    "struct internal::partial_lu_impl<double, ColMajor, int, Dynamic>"
    "struct internal::triangular_solve_matrix<double, Index, OnTheLeft, UnitLower, false, ColMajor, ColMajor, 1>"
    "struct internal::triangular_solve_matrix<double, Index, OnTheLeft, Upper, false, ColMajor, ColMajor, 1>"
    "struct internal::triangular_solve_vector<double, double, Index, OnTheLeft, UnitLower, false, ColMajor>"
    "struct internal::triangular_solve_vector<double, double, Index, OnTheLeft, Upper, false, ColMajor>")
endif()
nlmech_eigen_instances(decompositions
  "class PartialPivLU<MatrixXd>"
  "class FullPivLU<MatrixXd>"
  "class HouseholderQR<MatrixXd>"
  "class ColPivHouseholderQR<MatrixXd>"
  "class LLT<MatrixXd>"
  "LLT<MatrixXd>& LLT<MatrixXd>::compute(const EigenBase<MatrixXd>&)"
  "class JacobiSVD<MatrixXd>")
nlmech_eigen_instances(eigenvalues
  "class SelfAdjointEigenSolver<MatrixXd>"
  "SelfAdjointEigenSolver<MatrixXd>& SelfAdjointEigenSolver<MatrixXd>::compute(const EigenBase<MatrixXd>&, int)"
  "class EigenSolver<MatrixXd>"
  "EigenSolver<MatrixXd>& EigenSolver<MatrixXd>::compute(const EigenBase<MatrixXd>&, bool)"
  "class ComplexEigenSolver<MatrixXcd>"
  "ComplexEigenSolver<MatrixXcd>& ComplexEigenSolver<MatrixXcd>::compute(const EigenBase<MatrixXcd>&, bool)")

# What stands on nlmech::support without Eigen needs it as little as before: objects of an archive are linked where they are
# asked for.
set_source_files_properties(${sources} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
target_sources(nlmech_support PRIVATE ${sources})
target_link_libraries(nlmech_support PRIVATE $<BUILD_INTERFACE:Eigen3::Eigen>)
set(NLMECH_EIGEN_HEADERS ${headers})
set(NLMECH_EIGEN_HEADERS ${headers} PARENT_SCOPE)  # for chapters and tests
