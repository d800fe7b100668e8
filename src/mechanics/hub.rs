//! What the cables of a robot meet in: a small matrix, and how each cable takes hold of it.

use nalgebra::{DMatrix, Matrix2xX};
use num_dual::DualNum;

/// How a cable's first node moves with the hub: the node's displacement is B q, where q are the hub's displacements.
/// B is 2 × dof.
pub type Joint = Matrix2xX<f64>;

/// The hub with a joint per cable. A platform that is a point has two degrees of freedom, and every joint is I₂; a hub
/// that does not move has none.
#[derive(Clone, Debug, PartialEq)]
pub struct Hub<D = f64> {
    mass: DMatrix<D>,
    pub(crate) stiffness: DMatrix<D>,
    joints: Vec<Joint>,
}

impl<D: DualNum<Primitive = f64> + Copy> Hub<D> {
    /// A point of the `mass` m in kg where this many `cables` end: M = m I₂, B = I₂.
    pub fn point(mass: D, cables: usize) -> Self {
        Self {
            mass: DMatrix::from_diagonal_element(2, 2, mass),
            stiffness: DMatrix::from_element(2, 2, D::from(0.0)),
            joints: vec![Joint::identity(2); cables],
        }
    }

    /// A point that does not move: single cables with fixed ends, as textbooks have them.
    pub fn fixed(cables: usize) -> Self {
        let none = || DMatrix::from_element(0, 0, D::from(0.0));
        Self { mass: none(), stiffness: none(), joints: vec![Joint::zeros(0); cables] }
    }

    /// The hub's mass matrix, dof × dof, in kg for displacements in m.
    pub fn mass(&self) -> &DMatrix<D> {
        &self.mass
    }

    /// The hub's own stiffness matrix, dof × dof, in N/m for displacements in m. That of a point is zero.
    pub fn stiffness(&self) -> &DMatrix<D> {
        &self.stiffness
    }

    /// One joint per cable.
    pub fn joints(&self) -> &[Joint] {
        &self.joints
    }

    /// Degrees of freedom.
    pub fn dof(&self) -> usize {
        self.mass.nrows()
    }

    /// The mass m of a platform in kg; `None` where the hub does not move.
    pub fn platform_mass(&self) -> Option<D> {
        (self.dof() > 0).then(|| self.mass[(0, 0)])
    }
}
