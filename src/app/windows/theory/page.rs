//! What the page says. The letters are those of docs/theory.md, which has every step.

/// A piece of the page.
pub enum Part {
    /// The title of a section.
    Heading(&'static str),
    /// A paragraph.
    Text(&'static str),
    /// A text and the address that it leads to.
    Link(&'static str, &'static str),
    /// An equation, drawn by docs/equations/render.py.
    Equation {
        /// Its name there.
        name: &'static str,
        /// What it says, for those who cannot see it.
        words: &'static str,
        /// Its picture, as [`mask`](super::mask) reads it.
        picture: &'static [u8],
    },
}

use Part::{Heading, Link, Text};

macro_rules! equation {
    ($name:literal, $words:literal) => {
        Part::Equation {
            name: $name,
            words: $words,
            picture: include_bytes!(concat!("../../../../docs/equations/", $name, ".ink")),
        }
    };
}

/// The page from top to bottom.
pub static PAGE: &[Part] = &[
    Text(
        "What Tautline computes, and how far to trust it. The method is that of Aminpur and Farhadi [1], built on the \
         variable-length cable element of Du, Cui, Bao and Qiu [2]. Every step is in docs/theory.md, in the project's \
         files.",
    ),
    Heading("The cable element"),
    Text(
        "A cable of unstretched length L is a chain of n straight elements, each of the unstretched length l. Node 0 \
         is the platform, node n the winch. The stretch λ of element k, and the axial force N that goes with it:",
    ),
    equation!("stretch", "lambda is the distance from node k to node k plus 1, divided by l; l is L over n"),
    equation!(
        "axial_law",
        "N of lambda is one half EA times lambda cubed minus lambda, Green's law, or EA times lambda minus 1, the \
         engineering law"
    ),
    Text(
        "EA is the axial stiffness; the paper uses Green's law. Reeling changes L and with it every l: the nodes slide \
         along the material, and material flows through the elements. Its speed at the two ends of element k:",
    ),
    equation!("flow_speed", "w 0 is minus k times the rate of l; w 1 is minus k plus 1 times the rate of l"),
    Text(
        "The acceleration of this material, weighed over the element, gives three matrices: mass, flow and flow \
         stiffness, with μ the mass per unstretched length. Each acts on x and y alike.",
    ),
    equation!("mass", "M is mu l over 6 times the matrix 2, 1; 1, 2, for x and y alike"),
    equation!(
        "flow",
        "C is 2 mu times the matrix minus a, a; minus b, b, for x and y alike; a is w 0 over 3 plus w 1 over 6, b is \
         w 0 over 6 plus w 1 over 3"
    ),
    equation!(
        "flow_stiffness",
        "K dyn is mu times the matrix minus a prime, a prime; minus b prime, b prime, less mu over l times a third of \
         w 0 squared plus w 0 w 1 plus w 1 squared, times the matrix 1, minus 1; minus 1, 1; a prime and b prime are \
         made of the rates of w 0 and w 1 as a and b are made of w 0 and w 1"
    ),
    Text(
        "The symmetric part of C drains energy from a cable that is paid out and feeds one that is reeled in. The \
         second part of the flow stiffness is the centrifugal effect of material that runs along a bent cable: it acts \
         against the tension.",
    ),
    Heading("Static equilibrium with sag"),
    Text(
        "With w the weight per unstretched length, half of an element's weight w l acts on each of its nodes. A cable \
         that pulls at the platform with the force P has these forces in its elements, and these nodes:",
    ),
    equation!(
        "shape",
        "the force t k is P plus, upwards, w l times k plus one half; node k plus 1 is node k plus l lambda k along t \
         k; N of lambda k is the magnitude of t k"
    ),
    Text(
        "P and L alone determine the whole shape, and its last node must be the winch. Two cables are at equilibrium: \
         together with all the others they carry the platform of mass m.",
    ),
    equation!("balance", "the forces P of all cables add up to m g, upwards"),
    Text("Every other cable has a prescribed tension at the platform, a constant or a function of the pose:"),
    equation!(
        "tension_law",
        "the magnitude of P i is T i of x and y, the square root of the sum of the squares of h 0 plus h x x plus h y \
         y and v 0 plus v x x plus v y y"
    ),
    Text(
        "For one tension a heavy cable may have two shapes. The taut one is meant: the one that grows out of a \
         straight cable without weight. Where it ends, or where a cable would have to push, the pose is infeasible, \
         and the answer says which cable is to blame.",
    ),
    Heading("Quasi-static motion"),
    Text(
        "The platform moves along a straight line with the coordinate σ, and at each σ the robot is taken to be in \
         static balance. Write z for all unknowns and F for all static equations. Differentiated once and twice by σ \
         they give, exactly, the first and the second derivative of every length L:",
    ),
    equation!(
        "motion",
        "F of z and sigma is zero; F z times z prime is minus F sigma; F z times z double prime is minus the sum of F \
         sigma sigma, 2 F z sigma z prime, and F z z of z prime and z prime"
    ),
    Text("At the speed v, without acceleration along the line, the lengths change in time as"),
    equation!("rates", "the rate of L is v times L prime; its second rate is v squared times L double prime"),
    Text("Where the first derivative is negative the cable is reeled in."),
    Heading("Small vibrations"),
    Text("Small displacements of an element's nodes from the static shape meet its elastic stiffness,"),
    equation!("elastic", "K el is 1 over l times the matrix A, minus A; minus A, A"),
    Text("in one of two forms. The tangent stiffness is the exact linearisation, with e along the element:"),
    equation!(
        "tangent",
        "A is N over lambda times the identity minus e e transposed, plus the derivative of N by lambda times e e \
         transposed"
    ),
    Text(
        "The secant stiffness is the paper's simplification. It takes the string stiffness along the cable as well, \
         where the true one is far larger. That removes the fast axial waves and separates x from y.",
    ),
    equation!("secant", "A is N over lambda times the identity"),
    Text(
        "With damping in proportion to mass (α) and to elastic stiffness (β), the displacements q of all nodes that \
         move obey",
    ),
    equation!(
        "vibration",
        "M times the acceleration of q, plus C plus alpha M plus beta K el times the rate of q, plus K el plus K dyn \
         times q, is zero"
    ),
    Text("where C is proportional to v, and the flow stiffness to v²."),
    Heading("Eigenvalues and the critical speed"),
    Text(
        "These equations are looked at as they are at one instant. Their solutions then grow or decay with the \
         eigenvalues, for which λ stands from here on:",
    ),
    equation!(
        "eigenvalues",
        "lambda squared M plus lambda times C plus alpha M plus beta K el, plus K el plus K dyn, all times X, is zero; \
         q is X times e to the power of lambda t"
    ),
    Text(
        "The robot is called stable at the speed v when every eigenvalue has a negative real part. The critical speed \
         is where, coming from rest, one of them becomes positive for the first time:",
    ),
    equation!(
        "critical",
        "v crit is the lowest v above zero at which the largest real part of all eigenvalues becomes positive"
    ),
    Text("The frequency of that mode is"),
    equation!("frequency", "f is the magnitude of the imaginary part of lambda, over 2 pi"),
    Text(
        "Where it is zero the cable bows out without oscillating: divergence, otherwise flutter. The responsible cable \
         is the one whose own mass holds the largest share of the mode's kinetic energy.",
    ),
    Heading("How it is computed"),
    Text(
        "Along each cable the matrices are block tridiagonal and the cables meet in the platform alone, so that \
         elimination from the winches to the platform gives the determinant of the matrix Q in brackets above without \
         forming it, at a cost that grows with the number of elements only. The search wants the real ω and v with the \
         lowest v at which",
    ),
    equation!("determinant", "the determinant of Q of i omega and v is zero"),
    Text(
        "and counts the unstable eigenvalues just below its answer, by the argument principle: there must be none. \
         Where that leaves doubt, and without damping, all eigenvalues are computed in steps of 0.1 m/s, as in the \
         paper.",
    ),
    Heading("Limits of the criterion"),
    Text(
        "Please read this before you use a critical speed for anything. The lengths change all the time, yet the \
         criterion looks at the equations at one instant, as if their coefficients stayed what they are. That is the \
         paper's definition and ours. It is a convention, with consequences.",
    ),
    Text(
        "A cable that is reeled in looks unstable. For a single string whose length changes uniformly, to first order \
         in the speed,",
    ),
    equation!("reeled_in", "the real part of lambda is about minus the rate of L over 2 L"),
    Text(
        "That is positive at every speed while L falls. The exact solution of the same string keeps its amplitude: the \
         frequency rises and the energy grows, because the winch works against the tension, but the displacement does \
         not grow. So “unstable” need not mean that a vibration becomes visibly larger during the move.",
    ),
    Text("Damping decides. With damping in proportion to mass,"),
    equation!("damped", "the real part of lambda is about minus one half of the sum of alpha and the rate of L over L"),
    Text(
        "The robot counts as stable only while α exceeds about the part of its length that a cable loses per second; \
         stiffness damping protects high modes first. A critical speed found this way is in large part a statement \
         about α and β. Both must come from measurement. The values of the examples are assumptions.",
    ),
    Text("Waves are the other limit. When the flow of material comes near their speed in the cable,"),
    equation!("wave_speed", "c is the square root of N over lambda mu"),
    Text(
        "in unstretched metres per second, the cable loses its string stiffness whatever the damping. Whichever of the \
         two comes first governs the critical speed.",
    ),
    Text(
        "The criterion is good for comparing poses, directions, tension laws and designs under one rule, and for \
         finding the weak cable. It is not a safety margin. It says nothing about transients, control, or the \
         platform's rotation: here the platform is a point.",
    ),
    Heading("What the criterion says of a move"),
    Text(
        "Flown from rest to rest, time runs and is not frozen. The gain of a move is how many times larger any vibration \
         can be after it, measured by the root of energy over frequency, which a slow change of lengths leaves as it is.",
    ),
    Text(
        "The paper's robot on its way from x = −6 to 6 m by a quintic, damped: the frozen critical speed is 4.88 m/s at the \
         beginning, yet at peaks of 5, 8 and 11 m/s the gain is 0.35, 0.56 and 0.71, so every vibration ends smaller than \
         it began. Without damping the criterion calls every speed unstable, yet at a peak of 2 m/s the gain is 1.001.",
    ),
    Text(
        "Growth without bound begins beyond the wave limit, which this move reaches at a peak of 11.8 m/s: at 14 and 16 m/s \
         the gain is 1.3 and 5.0, and without damping it rises with every finer mesh. Up to the limit no amplitude grew by \
         more than 43 % in six other robots. The criterion errs the other way as well: in four of 22 test robots the wave \
         limit is below the frozen critical speed. So the ratio of speed to wave limit along a path is the verdict, and the \
         gain is a number. Cables that go slack by hard starts and stops come before either.",
    ),
    Heading("Sources"),
    Text(
        "[1] M. Aminpur, S. Farhadi, “Vibration Analysis of Cable-Driven Parallel Robots to Define Critical Speeds”, \
         AUT Journal of Mechanical Engineering, 2019.",
    ),
    Link("mej.aut.ac.ir/article_3359.html", "https://mej.aut.ac.ir/article_3359.html"),
    Text(
        "[2] J. Du, C. Cui, H. Bao, Y. Qiu, “Dynamic Analysis of Cable-Driven Parallel Manipulators Using a Variable \
         Length Finite Element”, J. Comput. Nonlinear Dynam. 10(1), 2015.",
    ),
];
