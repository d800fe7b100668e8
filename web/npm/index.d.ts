// Types of the package `tautline`. SI units throughout; x to the right, y up; cables are counted from 1.

/** A point [x, y] in m, or a direction. */
export type Vector = readonly [x: number, y: number];

// ---- The scenario: `tautline/scenario/1` and `tautline/scenario/2` -----------------------------------------------

/** A robot, where its platform is and how it moves: the scenario file as an object. There are no other fields. */
export interface Scenario {
    /** The format's name and version. The second one is needed where a cable has `cable` or there is a `path`; leave it out and
     *  either is read. */
    readonly schema?: "tautline/scenario/1" | "tautline/scenario/2";
    /** A title for people. */
    readonly name?: string;
    /** Gravitational acceleration, downward, in m/s²: 0 or more. 9.81 unless given. */
    readonly gravity?: number;
    /** What the cables are made of, unless one has something of its own. */
    readonly cable: CableMaterial;
    readonly platform: {
        /** In kg, greater than 0. */
        readonly mass: number;
    };
    /** 3 to 8 cables with different anchors, exactly two of them with tension "equilibrium". */
    readonly cables: readonly Cable[];
    /** A whole number from 2 to 200; 10 is usual. */
    readonly elements_per_cable: number;
    /** Damping in proportion to mass and to stiffness, αM + βK: 0 or more. */
    readonly damping: {
        /** In 1/s. */
        readonly alpha: number;
        /** In s. */
        readonly beta: number;
    };
    /** The paper's simplified stiffness or the full one. "secant" unless given. */
    readonly linearisation?: "secant" | "tangent";
    readonly motion: {
        /** Where the platform is, in m. */
        readonly position: Vector;
        /** Of any length but zero. */
        readonly direction: Vector;
        /** In m/s, 0 or more. */
        readonly speed: number;
    };
    /** Where the platform flies from there. */
    readonly path?: Path;
}

/** A path that begins at the motion's position. */
export interface Path {
    /** 1 to 100 points in m, passed in turn. */
    readonly points: readonly Vector[];
    /** Straight from point to point, at rest in each, or along a cubic spline. "stop" unless given. */
    readonly corners?: "stop" | "smooth";
    /** The motion profile, of each leg where corners are stops. "quintic" unless given; "constant" does not rest at its ends. */
    readonly profile?: "quintic" | "trapezoid" | "scurve" | "constant";
    /** The peak speed in m/s, greater than 0; that of the motion unless given. */
    readonly speed?: number;
    /** Of trapezoids and S-curves, in m/s², greater than 0. 1 unless given. */
    readonly acceleration?: number;
    /** Of S-curves, in m/s³, greater than 0. 10 unless given. */
    readonly jerk?: number;
    /** How long a flight goes on after the end, in s: 0 or more, 0 unless given. */
    readonly hold?: number;
}

export interface CableMaterial {
    /** In Pa, greater than 0. */
    readonly youngs_modulus: number;
    /** Cross-section in m², greater than 0. */
    readonly area: number;
    /** Per unstretched length in kg/m, greater than 0. */
    readonly mass_per_length: number;
    /** The strain measure. "green" unless given. */
    readonly strain?: "green" | "engineering";
}

/** One cable, from the platform to its winch. */
export interface Cable {
    /** The winch point in m. */
    readonly anchor: Vector;
    readonly tension: Tension;
    /** What this cable alone has in the place of the scenario's `cable`: any of its fields. */
    readonly cable?: Partial<CableMaterial>;
}

/** What sets a cable's tension: the platform's equilibrium, a constant in N, or a law of the position (x, y). */
export type Tension = "equilibrium" | ConstantTension | TensionLaw;

export interface ConstantTension {
    /** In N, greater than 0. */
    readonly constant: number;
}

/** hypot(h0 + hx x + hy y, v0 + vx x + vy y), in N. */
export interface TensionLaw {
    readonly horizontal: readonly [h0: number, hx: number, hy: number];
    readonly vertical: readonly [v0: number, vx: number, vy: number];
}

// ---- Results -----------------------------------------------------------------------------------------------------

/** How the search for a critical speed ended: there is one, there is none up to its limit, there is no equilibrium to begin
 *  with, or it could not be computed. */
export type Status = "found" | "none" | "infeasible" | "failed";

/** The speed at which a winch reels as fast as waves run along its cable. */
export interface WaveLimit {
    /** Of the platform, in m/s. */
    speed: number;
    /** The cable that reaches it first, from 1. */
    cable: number;
    /** Whether that cable is reeled in. */
    reeled_in: boolean;
}

/** The acceleration at which a cable goes slack. */
export interface SlackLimit {
    /** In m/s². */
    value: number;
    /** The cable, from 1. */
    cable: number;
}

/** How hard the platform may speed up or brake from rest before a cable goes slack, by statics. Flown, slack comes earlier: at
 *  up to 30 % less peak speed, which is half the acceleration. */
export interface SlackAcceleration {
    /** Along the motion; null where no cable goes slack. */
    accelerating: SlackLimit | null;
    /** Against it, as a positive number; null where no cable goes slack. */
    braking: SlackLimit | null;
    /** The platform's deviation in m per m/s². */
    deviation_per_acceleration: number;
}

/** How stability is lost: an oscillation grows, or a displacement without oscillating. */
export type Kind = "flutter" | "divergence";

/** `tautline/analysis/1`, what `tautline analyze --json` prints. */
export type Analysis = FeasibleAnalysis | InfeasibleAnalysis;

interface AnalysisFields {
    schema: "tautline/analysis/1";
    /** The scenario's speed in m/s. */
    speed: number;
    /** The speed in m/s up to which the critical speed was searched. */
    searched_up_to: number;
}

/** The pose has a taut equilibrium. */
export interface FeasibleAnalysis extends AnalysisFields {
    feasible: true;
    /** A sentence where the answer is not complete, because something could not be computed. */
    reason: string | null;
    /** One entry per cable; empty where the motion or the vibration leaves the range of floating point. */
    cables: CableAtRest[];
    /** All eigenvalues at the scenario's speed in 1/s, multiplicity included; empty where they could not be computed. */
    eigenvalues: [re: number, im: number][];
    /** The largest real part, in 1/s. */
    max_growth_rate: number | null;
    /** Whether every real part is negative. */
    stable: boolean | null;
    /** Whether the robot is stable at rest. */
    stable_at_rest: boolean | null;
    /** How the search ended. */
    status: "found" | "none" | "failed";
    /** The smallest speed at which a vibration begins to grow; null where none was found up to `searched_up_to`. */
    critical: Critical | null;
    /** Null where no cable moves. */
    wave_limit: WaveLimit | null;
    /** Null where it could not be computed. */
    slack_acceleration: SlackAcceleration | null;
}

/** The pose has none, or (null) the equilibrium could not be computed. */
export interface InfeasibleAnalysis extends AnalysisFields {
    feasible: false | null;
    /** Why, as a sentence. */
    reason: string;
    cables: [];
    eigenvalues: [];
    max_growth_rate: null;
    stable: null;
    stable_at_rest: null;
    status: "infeasible" | "failed";
    critical: null;
    wave_limit: null;
    slack_acceleration: null;
}

/** One cable at rest. */
export interface CableAtRest {
    /** In m. */
    unstretched_length: number;
    /** In N. */
    tension_at_platform: number;
    /** In N. */
    tension_at_winch: number;
    /** Change of the unstretched length with the platform's path. */
    length_rate: number;
    /** Its second derivative, in 1/m. */
    length_curvature: number;
    /** From the platform to the winch, in m. */
    nodes: [x: number, y: number][];
}

/** A critical speed. */
export interface Critical {
    /** In m/s. */
    speed: number;
    /** In Hz; 0 for divergence. */
    frequency_hz: number;
    kind: Kind;
    /** The responsible cable, from 1. */
    cable: number;
}

/** What `criticalSpeed` gives; `speed` tells one from the other. */
export type CriticalSpeed = FoundCriticalSpeed | NoCriticalSpeed;

export interface FoundCriticalSpeed extends Critical {
    feasible: true;
    reason: null;
    status: "found";
    /** In m/s: the limit of the search. */
    searched_up_to: number;
    /** Null where no cable moves. */
    wave_limit: WaveLimit | null;
}

/** There is none up to `searched_up_to`, or it is not known. */
export interface NoCriticalSpeed {
    /** Whether the pose has a taut equilibrium; null where that could not be computed. */
    feasible: boolean | null;
    /** Why it is not known, as a sentence; null where all speeds up to `searched_up_to` are stable. */
    reason: string | null;
    speed: null;
    frequency_hz: null;
    kind: null;
    cable: null;
    status: "none" | "infeasible" | "failed";
    /** In m/s. */
    searched_up_to: number;
    /** Null where no cable moves, or there is no equilibrium. */
    wave_limit: WaveLimit | null;
}

/** One point of a map; `critical_speed` tells one from the other. */
export type MapRow = FoundMapRow | EmptyMapRow;

export interface FoundMapRow {
    /** In m. */
    x: number;
    /** In m. */
    y: number;
    feasible: true;
    /** In m/s. */
    critical_speed: number;
    /** In Hz; 0 for divergence. */
    frequency_hz: number;
    kind: Kind;
    /** The responsible cable, from 1. */
    cable: number;
    /** In m/s; of several directions the lowest. Null where no cable moves. */
    wave_limit: number | null;
    status: "found";
}

/** A point without a critical speed: `status` says why. */
export interface EmptyMapRow {
    /** In m. */
    x: number;
    /** In m. */
    y: number;
    /** Null where that could not be computed. */
    feasible: boolean | null;
    critical_speed: null;
    frequency_hz: null;
    kind: null;
    cable: null;
    /** In m/s; of several directions the lowest. */
    wave_limit: number | null;
    status: "none" | "infeasible" | "failed";
}

/** `tautline/flight/1`, what `tautline fly --json` prints. */
export interface Flight {
    schema: "tautline/flight/1";
    /** Whether there is a taut equilibrium all along the path. */
    feasible: boolean;
    /** Why there is none, or why the flight ends early, as a sentence. */
    reason: string | null;
    /** How long the move takes, in s. */
    duration: number;
    /** Until when it was to be flown, in s. */
    end: number;
    /** The platform's largest distance from its path, in m. */
    max_deviation: number | null;
    /** The same after the end of the move, in m; null without `hold`. */
    residual: number | null;
    /** The first moment (s) at which an element has to push, its cable, and the least force of the whole flight (N). */
    slack: { time: number; cable: number; force: number } | null;
    /** How many times larger a vibration can be after the move: amplitude ratios. */
    gain: { action: number; energy: number; displacement: number } | null;
    /** What the frozen eigenvalues say instead. */
    frozen_growth: number | null;
    /** The largest speed over wave limit: below 1 nothing grows without bound. */
    wave_ratio: { value: number; s: number; cable: number; reeled_in: boolean } | null;
    /** Along the path: in m/s, at the arc length s (m). */
    least_critical_speed: { speed: number; s: number } | null;
    /** Along the path: in m/s, at the arc length s (m). */
    least_wave_limit: { speed: number; s: number } | null;
    samples: FlightSample[];
}

/** A flight at one time. SI units; lists have an entry per cable. */
export interface FlightSample {
    t: number;
    s: number;
    v: number;
    a: number;
    deviation: [x: number, y: number];
    deviation_velocity: [x: number, y: number];
    tension_at_platform: number[];
    element_force_at_winch: number[];
    unstretched_length: number[];
    smallest_element_force: number;
}

/** `tautline/limits/1`, what `tautline limits --json` prints. */
export interface Limits {
    schema: "tautline/limits/1";
    feasible: boolean;
    /** Why there is no such move, as a sentence. */
    reason: string | null;
    /** In s. */
    duration: number | null;
    /** In m/s. */
    peak_speed: number | null;
    rows: LimitsRow[];
}

/** The fastest move at one place. SI units; lists have an entry per cable. */
export interface LimitsRow {
    t: number;
    s: number;
    position: [x: number, y: number];
    v: number;
    /** From here to the next row. */
    a: number;
    unstretched_length: number[];
    rate: number[];
    acceleration: number[];
    /** At rest. */
    tension_at_platform: number[];
    /** At rest. */
    tension_at_winch: number[];
}

// ---- Functions ---------------------------------------------------------------------------------------------------

export interface SearchOptions {
    /** Critical speeds are searched up to this speed in m/s, greater than 0 and at most 10000. 40 unless given. */
    maxSpeed?: number | undefined;
}

/**
 * In which direction the platform moves: as the scenario says, in the worst of 16 directions (the one with the lowest
 * critical speed), along an axis, or along a vector of any length but zero.
 */
export type Direction = "motion" | "worst" | "+x" | "-x" | "+y" | "-y" | Vector;

export interface MapOptions extends SearchOptions {
    /** Points in a row: a whole number from 1 to 2000. */
    nx: number;
    /** Rows: a whole number from 1 to 2000. */
    ny: number;
    /** "motion" unless given. */
    direction?: Direction | undefined;
    /** Called from time to time, and at the end, with the number of rows that are done and of all. */
    onProgress?: ((done: number, total: number) => void) | undefined;
    /** Its abort stops the map; the promise is rejected with the signal's reason. */
    signal?: AbortSignal | undefined;
}

/** Where the WebAssembly module may come from. */
export type ModuleSource = string | URL | Request | Response | BufferSource | WebAssembly.Module;

/**
 * Loads the WebAssembly module; the other functions throw before it is done. Further calls do nothing.
 *
 * @param source Where the module is, if not beside the package's files: an address or the module itself.
 */
export function init(source?: ModuleSource | Promise<ModuleSource>): Promise<void>;

/**
 * Statics, all eigenvalues at the scenario's speed, and the critical speed.
 *
 * @param scenario An object, or the text of a scenario file.
 * @throws {Error} All that is wrong, a line per field with its path, its value and what is allowed.
 */
export function analyze(scenario: Scenario | string, options?: SearchOptions): Analysis;

/** The critical speed alone: faster, for those who ask again and again. Arguments and errors as for `analyze`. */
export function criticalSpeed(scenario: Scenario | string, options?: SearchOptions): CriticalSpeed;

/**
 * The critical speed at nx × ny points of the workspace, the rectangle around all anchors: along the rows, from the
 * lowest one up. Computed in the calling thread, with frequent pauses that let others have their turn.
 *
 * Errors as for `analyze`; the promise is rejected with them.
 */
export function map(scenario: Scenario | string, options: MapOptions): Promise<MapRow[]>;

export interface FlightOptions {
    /** An impulse on the platform at the beginning, in N s. */
    kick?: Vector | undefined;
    /** How many samples, equally spaced: a whole number from 2 on. 21 unless given. */
    samples?: number | undefined;
    /** The platform's error that the steps are chosen for, in m. 1e-6 unless given. */
    accuracy?: number | undefined;
    /** Its abort stops the flight; the promise is rejected with the signal's reason. */
    signal?: AbortSignal | undefined;
}

/**
 * The non-linear flight along the scenario's path, from the quasi-static state, and the growth along it. Computed in the calling
 * thread, with frequent pauses that let others have their turn.
 *
 * Errors as for `analyze`; the promise is rejected with them.
 */
export function fly(scenario: Scenario | string, options?: FlightOptions): Promise<Flight>;

export interface LimitsOptions {
    /** The part of the local limits that the speed keeps below. 0.8 unless given. */
    safety?: number | undefined;
    /** Which local limits act: the frozen critical speed, the wave limit, or both, as unless given. */
    by?: "frozen" | "wave" | "both" | undefined;
    /** Of the platform along its path, in m/s². Limits that are not given do not act. */
    acceleration?: number | undefined;
    /** Of every winch, in m/s of cable. */
    winchSpeed?: number | undefined;
    /** Of every winch, in m/s² of cable. */
    winchAcceleration?: number | undefined;
    /** The part of the slack acceleration that the acceleration keeps below. */
    slack?: number | undefined;
    /** Its abort stops it; the promise is rejected with the signal's reason. */
    signal?: AbortSignal | undefined;
}

/** The fastest move from rest to rest along the scenario's path. Errors and pauses as for `fly`. */
export function limits(scenario: Scenario | string, options?: LimitsOptions): Promise<Limits>;
