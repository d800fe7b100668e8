//! Linear equations of chains that meet in a hub, in O(n).
//!
//! Such a matrix is block tridiagonal along each chain, and the chains meet in the hub alone: an arrow. Every chain is
//! eliminated from its far end, which does not move, to the hub. There it leaves a block D, by which the chain answers a
//! displacement of its joint, and the hub's own matrix becomes H + Σ Bᵀ D B. docs/theory.md section 11.
//!
//! This serves all kinds of numbers: real ones for a stiffness, complex ones for Q(λ), dual ones for derivatives.

use nalgebra::allocator::Allocator;
use nalgebra::{ComplexField, Const, DMatrix, DVector, DefaultAllocator, Dim, Dyn, OMatrix, SMatrix, SVector, Scalar};

/// An inverse has fourth powers in it: those of larger numbers, and of smaller ones than the reciprocal, leave the range
/// of floating point.
const LARGE: f64 = 1e75;

/// A block over one node and one node, of one or two directions.
pub type Block<T, const N: usize> = SMatrix<T, N, N>;
/// What an element adds to the matrix: the blocks of its two nodes, the one on the hub's side first.
pub type Blocks<T, const N: usize> = [[Block<T, N>; 2]; 2];

/// An inner node after elimination.
#[derive(Clone, Debug)]
struct Node<T: Scalar, const N: usize> {
    /// The inverse of its pivot.
    pivot: Block<T, N>,
    /// The matrix's block in the row of the node on the hub's side and this column.
    inward: Block<T, N>,
    /// The matrix's block in this row and the column of the node on the hub's side.
    outward: Block<T, N>,
}

/// A chain after elimination.
#[derive(Clone, Debug)]
struct Chain<T: Scalar, const N: usize> {
    /// From the hub outwards.
    nodes: Vec<Node<T, N>>,
    /// B: the displacement of the chain's first node is B times the hub's.
    joint: OMatrix<T, Const<N>, Dyn>,
}

/// A matrix of chains and hub, eliminated.
#[derive(Clone, Debug)]
pub struct Arrow<T: Scalar, const N: usize> {
    chains: Vec<Chain<T, N>>,
    /// The inverse of what elimination makes of the hub's matrix.
    hub: DMatrix<T>,
}

/// A vector over the hub and the inner nodes of all chains.
#[derive(Clone, Debug, PartialEq)]
pub struct ArrowVector<T: Scalar, const N: usize> {
    /// Over the hub's degrees of freedom.
    pub hub: DVector<T>,
    /// Over the inner nodes of each chain, from the hub outwards.
    pub chains: Vec<Vec<SVector<T, N>>>,
}

impl<T: ComplexField + Copy, const N: usize> Arrow<T, N> {
    /// Eliminates the matrix of chains of elements and a `hub`, whose own matrix is given. `blocks` tells what an element
    /// adds. Each chain, of at least one element, comes with the joint of its first node.
    pub fn factor<'a, E: 'a>(
        mut hub: DMatrix<T>,
        chains: impl IntoIterator<Item = (&'a [E], OMatrix<T, Const<N>, Dyn>)>,
        blocks: impl Fn(&E) -> Blocks<T, N>,
    ) -> Self {
        let eliminate = |(elements, joint): (&'a [E], OMatrix<T, Const<N>, Dyn>)| {
            let mut nodes = Vec::with_capacity(elements.len().saturating_sub(1));
            let mut before: Option<Blocks<T, N>> = None;
            // What the nodes farther out add to a node's own block.
            let mut outer = Block::<T, N>::zeros();
            for element in elements.iter().rev() {
                let here = blocks(element);
                if let Some(farther) = before {
                    let [[_, inward], [outward, own]] = here;
                    let pivot = inverse(own + farther[0][0] - outer);
                    outer = inward * pivot * outward;
                    nodes.push(Node { pivot, inward, outward });
                }
                before = Some(here);
            }
            nodes.reverse();
            let at_joint = before.map_or_else(Block::zeros, |first| first[0][0]) - outer;
            hub += joint.transpose() * (at_joint * &joint);
            Chain { nodes, joint }
        };
        let chains = chains.into_iter().map(eliminate).collect();
        let hub = inverse(hub);
        Self { chains, hub }
    }

    /// x with A x = `right`.
    pub fn solve(&self, right: &ArrowVector<T, N>) -> ArrowVector<T, N> {
        let mut x = right.clone();
        for (chain, values) in self.chains.iter().zip(&mut x.chains) {
            let joint = chain.reduce(values, |node, value| node.inward * (node.pivot * value));
            x.hub -= chain.joint.tr_mul(&joint);
        }
        x.hub = &self.hub * x.hub;
        for (chain, values) in self.chains.iter().zip(&mut x.chains) {
            chain.substitute(&x.hub, values, |node, value, inner| node.pivot * (value - node.outward * inner));
        }
        x
    }

    /// x with Aᵀ x = `right`.
    pub fn solve_transposed(&self, right: &ArrowVector<T, N>) -> ArrowVector<T, N> {
        let mut x = right.clone();
        for (chain, values) in self.chains.iter().zip(&mut x.chains) {
            let joint = chain.reduce(values, |node, value| node.outward.tr_mul(&node.pivot.tr_mul(&value)));
            x.hub -= chain.joint.tr_mul(&joint);
        }
        x.hub = self.hub.tr_mul(&x.hub);
        for (chain, values) in self.chains.iter().zip(&mut x.chains) {
            let back = |node: &Node<T, N>, value: SVector<T, N>, inner: SVector<T, N>| {
                node.pivot.tr_mul(&(value - node.inward.tr_mul(&inner)))
            };
            chain.substitute(&x.hub, values, back);
        }
        x
    }

    /// ln det A, the sum of the pivots' logarithms.
    pub fn log_det(&self) -> T
    where
        Const<N>: nalgebra::DimMin<Const<N>, Output = Const<N>>,
    {
        let pivots = self.chains.iter().flat_map(|chain| &chain.nodes).map(|node| node.pivot.determinant());
        pivots.chain([self.hub.determinant()]).fold(T::zero(), |log, inverse| log - inverse.ln())
    }
}

impl<T: ComplexField + Copy, const N: usize> Chain<T, N> {
    /// Carries a right side to the joint, and gives what arrives there. `carry` takes what stands at a node to the next one
    /// towards the hub.
    fn reduce(
        &self,
        values: &mut [SVector<T, N>],
        carry: impl Fn(&Node<T, N>, SVector<T, N>) -> SVector<T, N>,
    ) -> SVector<T, N> {
        let mut carried = SVector::zeros();
        for (node, value) in self.nodes.iter().zip(values).rev() {
            *value -= carried;
            carried = carry(node, *value);
        }
        carried
    }

    /// Carries the hub's solution outwards. `solve` gives a node's solution, from its right side and from the solution of the
    /// node before.
    fn substitute(
        &self,
        hub: &DVector<T>,
        values: &mut [SVector<T, N>],
        solve: impl Fn(&Node<T, N>, SVector<T, N>, SVector<T, N>) -> SVector<T, N>,
    ) {
        let mut inner = &self.joint * hub;
        for (node, value) in self.nodes.iter().zip(values) {
            *value = solve(node, *value, inner);
            inner = *value;
        }
    }
}

/// The inverse. Where the matrix is singular to rounding, it is that of a matrix a little aside.
fn inverse<T: ComplexField + Copy, R: Dim>(matrix: OMatrix<T, R, R>) -> OMatrix<T, R, R>
where
    DefaultAllocator: Allocator<R, R> + Allocator<R>,
{
    let zero = nalgebra::zero::<T::RealField>();
    let size = matrix.iter().fold(zero.clone(), |size, entry| {
        let [re, im] = [entry.real().abs(), entry.imaginary().abs()];
        let larger = if im > re { im } else { re };
        if larger > size { larger } else { size }
    });
    let large = nalgebra::convert::<f64, T::RealField>(LARGE);
    if size > large || (size > zero && size < large.clone().recip()) {
        // Part by part: a complex quotient has the square of the size in it.
        return inverse(matrix.map(|entry| entry.unscale(size.clone()))).map(|entry| entry.unscale(size.clone()));
    }
    if let Some(inverse) = matrix.clone_owned().try_inverse() {
        return inverse;
    }
    let least = nalgebra::convert::<f64, T::RealField>(f64::MIN_POSITIVE);
    let size = if size > least { size } else { least };
    let nudge = T::from_real(size * nalgebra::convert(f64::EPSILON));
    let (rows, columns) = matrix.shape_generic();
    let nudged = matrix + OMatrix::<T, R, R>::from_diagonal_element_generic(rows, columns, nudge);
    nudged.try_inverse().unwrap_or_else(|| OMatrix::identity_generic(rows, columns))
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Complex, Matrix2, Vector2};
    use num_dual::Dual64;

    type C64 = Complex<f64>;

    #[test]
    fn inverses_are_found_over_the_whole_range_of_floating_point() {
        let number = C64::new;
        let matrix = Matrix2::new(number(2.0, 1.0), number(0.5, -3.0), number(-1.0, 0.0), number(4.0, 2.0));
        let expected = matrix.try_inverse().unwrap();
        for size in [1e-300, 1e-160, 1e-80, 1.0, 1e80, 1e160, 1e300] {
            let found = inverse(matrix * C64::from(size)) * C64::from(size);
            assert!((found - expected).norm() < 1e-14 * expected.norm(), "{size:e}: {found} instead of {expected}");
        }
    }

    /// What a singular matrix leaves of a vector is its null vector, the larger the nearer to singular.
    #[test]
    fn of_a_singular_matrix_the_null_vector_is_left() {
        let number = |x: f64| C64::new(x, 0.0);
        for size in [1e-40, 1.0, 1e40] {
            let left = inverse(Matrix2::repeat(number(size))) * Vector2::new(number(size), number(0.0));
            assert!(left.norm() > 1e12, "{left}");
            assert!((left / left.x - Vector2::new(number(1.0), number(-1.0))).norm() < 1e-12, "{left}");
        }
    }

    /// Numbers in −1..1 that follow no pattern.
    fn numbers() -> impl FnMut() -> f64 {
        let mut seed = 0_u32;
        move || {
            seed += 1;
            2.0 * (f64::from(seed) * 0.618_033_988_749_895).fract() - 1.0
        }
    }

    /// Chains of 4 and of 2 elements, held by joints of a hub with three degrees of freedom; and the same as a full matrix.
    fn example<T: ComplexField + Copy>(mut number: impl FnMut() -> T) -> (Arrow<T, 2>, ArrowVector<T, 2>, DMatrix<T>) {
        let lengths = [4, 2];
        let elements: Vec<Vec<Blocks<T, 2>>> = lengths
            .map(|n| (0..n).map(|_| [0, 1].map(|_| [0, 1].map(|_| Block::from_fn(|_, _| number())))).collect())
            .to_vec();
        let joints: Vec<_> = lengths.iter().map(|_| OMatrix::<T, Const<2>, Dyn>::from_fn(3, |_, _| number())).collect();
        let hub = DMatrix::from_fn(3, 3, |_, _| number());
        let right = ArrowVector {
            hub: DVector::from_fn(3, |_, _| number()),
            chains: lengths.iter().map(|n| (1..*n).map(|_| SVector::from_fn(|_, _| number())).collect()).collect(),
        };
        let mut full = DMatrix::zeros(3 + 2 * 4, 3 + 2 * 4);
        full.view_mut((0, 0), (3, 3)).copy_from(&hub);
        let mut first = 3;
        for (elements, joint) in elements.iter().zip(&joints) {
            let size = 3 + 2 * 4;
            // The displacement of node k is this matrix times all unknowns.
            let node = |k: usize| {
                let mut of = DMatrix::<T>::zeros(2, size);
                match k {
                    0 => of.view_mut((0, 0), (2, 3)).copy_from(joint),
                    _ if k == elements.len() => {}
                    _ => of.view_mut((0, first + 2 * (k - 1)), (2, 2)).fill_with_identity(),
                }
                of
            };
            for (k, blocks) in elements.iter().enumerate() {
                for (i, row) in blocks.iter().enumerate() {
                    for (j, block) in row.iter().enumerate() {
                        full += node(k + i).transpose() * block * node(k + j);
                    }
                }
            }
            first += 2 * (elements.len() - 1);
        }
        let chains = elements.iter().map(Vec::as_slice).zip(joints.iter().cloned());
        (Arrow::factor(hub, chains, |blocks| *blocks), right, full)
    }

    fn stacked<T: ComplexField + Copy>(vector: &ArrowVector<T, 2>) -> DVector<T> {
        let inner = vector.chains.iter().flatten().flat_map(|node| node.iter());
        DVector::from_iterator(11, vector.hub.iter().chain(inner).copied())
    }

    /// Solutions, those of the transposed matrix and the determinant are those of the full matrix.
    fn check<T: ComplexField<RealField = f64> + Copy>(number: impl FnMut() -> T) {
        let (arrow, right, full) = example(number);
        for (found, matrix) in [(arrow.solve(&right), full.clone()), (arrow.solve_transposed(&right), full.transpose())]
        {
            let expected = matrix.lu().solve(&stacked(&right)).unwrap();
            let error = (stacked(&found) - &expected).norm();
            assert!(error < 1e-12 * expected.norm(), "{error:e}");
        }
        let (found, expected) = (arrow.log_det().exp(), full.determinant());
        assert!((found - expected).modulus() < 1e-12 * expected.modulus(), "{found} {expected}");
    }

    #[test]
    fn an_arrow_is_its_full_matrix() {
        let mut number = numbers();
        check(|| C64::new(number(), number()));
        let mut number = numbers();
        check(|| number() + C64::new(0.0, 0.0));
    }

    /// The derivative of ln det A is the trace of A⁻¹ dA.
    #[test]
    fn dual_numbers_give_the_derivative_of_the_determinant() {
        let mut number = numbers();
        let (arrow, _, full) = example(|| Dual64::new(number(), number()));
        let inverse = full.map(|entry| entry.re).try_inverse().unwrap();
        let expected = (inverse * full.map(|entry| entry.eps)).trace();
        let found = arrow.log_det().eps;
        assert!((found - expected).abs() < 1e-11 * expected.abs(), "{found} {expected}");
    }
}
