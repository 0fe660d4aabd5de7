/// The contacts, limits and motors of an island with all other rows eliminated.
#pragma once

#include <vector>

#include "solver/newton/dense.h"

namespace pbmpi::solver {

using Numbers = std::vector<double>;  ///< [rows] of a ConeProblem

/// Velocities u = W r + q [m/s or rad/s] for impulses r [N s or N m s]. Rows: for each contact its normal and
/// two across, then the rows with bounds.
///   contacts: r_n >= 0, u_n >= 0, r_n u_n = 0, abs(r_t) <= mu r_n, r_t = -mu r_n u_t / abs(u_t) if u_t != 0
///   bounds:   low <= r <= high; u = 0 between them, u >= 0 at the lower, u <= 0 at the upper
struct ConeProblem {
  DenseMatrix w;      ///< symmetric
  Numbers q;          ///< [rows]
  Numbers mu;         ///< [contacts]
  Numbers low, high;  ///< [rows with bounds]

  int num_contacts() const { return static_cast<int>(mu.size()); }
  int num_rows() const { return static_cast<int>(q.size()); }
};

/// The law of a ConeProblem as an equation F(r, u) = 0, and its generalised derivative (P. Alart and A.
/// Curnier, "A mixed formulation for frictional contact problems prone to Newton like solution methods",
/// CMAME 1991):
///   F_n = r_n - max(0, y_n), F_t = r_t - y_t min(1, mu max(0, y_n) / abs(y_t)) with y = r - rho u.
class ConeMap {
 public:
  /// `problem` is borrowed. rho is 1 / W_ii for normals and rows with bounds, and 1 / the largest eigenvalue
  /// of the two rows' block for the rows across.
  explicit ConeMap(const ConeProblem& problem);

  /// F [rows] [N s].
  void evaluate(const Numbers& r, const Numbers& u, Numbers& f) const;
  /// dF / dr where du = (W + shift) dr.
  void differentiate(const Numbers& r, const Numbers& u, double shift, DenseMatrix& jacobian) const;
  double rho(int row) const { return rho_[static_cast<std::size_t>(row)]; }

 private:
  /// y = r - rho u of a contact.
  struct Trial {
    double normal, across[2], length, bound;
  };
  Trial try_contact(int contact, const Numbers& r, const Numbers& u) const;
  double try_bounded(int row, const Numbers& r, const Numbers& u) const {
    const auto i = static_cast<std::size_t>(row);
    return r[i] - rho_[i] * u[i];
  }
  /// Adds factor du_row / dr.
  void add_speed(int row, double factor, double shift, double* to) const;
  void differentiate_slide(int contact, const Trial& trial, double shift, DenseMatrix& jacobian) const;

  const ConeProblem& problem_;
  Numbers rho_;
};

double length_of(const Numbers& numbers);
/// u = W r + q.
void find_speeds(const ConeProblem& problem, const Numbers& r, Numbers& u);

}  // namespace pbmpi::solver
