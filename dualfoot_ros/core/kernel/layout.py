"""Where each number stands in the flat workspaces of the kernel.

One float64 array ``w`` and one int64 array ``n`` hold everything a tracker is: the state of the
filter (which a snapshot copies), its constants, scratch space, the history of samples and the
ring of snapshots.  All offsets are compile-time constants but for the two rings at the end.
"""

lanes = range  # of a loop no turn of which needs another: a compiler takes several at once

# --- state: what a snapshot copies -------------------------------------------------------------
FOOT = 40  # stride from the left foot's nominal state to the right foot's
POS = 0  # position, m
VEL = 3  # velocity, m/s
ROT = 6  # R_nb, body to navigation, row-major 3x3
BG = 15  # gyro bias, rad/s
BA = 18  # accelerometer bias, m/s^2
ALPHA = 21  # previous rotation increment, rad
GAMMA = 24  # previous velocity increment, m/s
RATE = 27  # last bias-corrected angular rate, rad/s
FORCE = 30  # last bias-corrected specific force, m/s^2
FOLLOWS = 33  # 1 when the sample before was the one before in time, 0 at the start and after a gap
WALKED = 34  # time walked since the height was observed, s; in the left foot's state only
TRACKED = 35  # time since the start, s; in the left foot's state only
FLOOR_VEL = FOOT + 34  # in the right foot's state: velocity of the floor under both feet, m/s
FLOOR_STD = FOOT + 37  # its standard deviation, horizontal; 0 with the next: the floor is at rest
FLOOR_UP_STD = FOOT + 38  # vertical, m/s
FLOOR_S = FOOT + 39  # time since it has moved, s

ROW = 16  # covariance blocks are 15 rows of 15, padded to 16
BLOCK = 15 * ROW
PLL = 2 * FOOT  # covariance of the left foot's error state
PRR = PLL + BLOCK  # covariance of the right foot's error state
PLR = PRR + BLOCK  # cross-covariance, rows left, columns right
STATE = PLR + BLOCK  # size of a snapshot

# error state of one foot, eq. (4): position, velocity, attitude, gyro bias, accelerometer bias
E_POS, E_VEL, E_ATT, E_BG, E_BA = 0, 3, 6, 9, 12
ERRORS = 15  # error states of one foot
CONSIDERED_FOOT = 4  # of them that a zero-velocity update takes as known: heading, gyro bias
CONSIDERED = 12  # most states that a gain takes as known, four at a time
KNOW_ALL, KNOW_COMMON, KEEP_PLACE, KNOW_NOTHING = 0, 1, 2, 3  # what an update leaves alone
ROWS_POS = ROW * E_POS  # from the start of a covariance block to the rows of each of them
ROWS_VEL = ROW * E_VEL
ROWS_ATT = ROW * E_ATT
ROWS_BG = ROW * E_BG
ROWS_BA = ROW * E_BA
PLACE = 0x7FFFFFFF  # mask of an offset in ``w``: so no compiler need think it negative
DIAGONAL = ROW + 1  # from an element of the diagonal to the next

# --- constants, set when the tracker is aligned --------------------------------------------------
C_GRAVITY = STATE
C_Q_VEL = C_GRAVITY + 1  # noise powers per second
C_Q_ATT = C_GRAVITY + 2
C_Q_BG = C_GRAVITY + 3
C_Q_BA = C_GRAVITY + 4
C_BIAS_RATE = C_GRAVITY + 5  # 1 / correlation time, 1/s
C_ZUPT_VAR = C_GRAVITY + 6  # (m/s)^2
C_ZUPT_RATE_VAR = C_GRAVITY + 7  # (m/s per rad/s)^2
C_GLRT_FORCE = C_GRAVITY + 8  # 1 / sigma_a^2
C_GLRT_RATE = C_GRAVITY + 9  # 1 / sigma_w^2
C_GLRT_THRESHOLD = C_GRAVITY + 10
C_WATCH = C_GRAVITY + 11  # squared distance of the feet beyond which a method wants to know, m^2
C_ZUPT_STILL_VAR = C_GRAVITY + 12  # (m/s)^2, once a stance has lasted
C_BIAS_KNOWN_VAR = C_GRAVITY + 15  # (rad/s)^2, up to which a gyro bias counts as known
C_ADAPTS = C_GRAVITY + 14  # 1 when the threshold follows the walk
C_ZUPT_CONSIDERS = C_GRAVITY + 13  # 1 when a zero-velocity update takes heading and bias as known
C_HEIGHT_DRIFT = (
    C_GRAVITY + 16
)  # (m/s)^2, vertical velocity that zero-velocity updates let through
C_PERIOD = C_GRAVITY + 17  # nominal interval of the samples, s
C_FOOT = C_GRAVITY + 18  # then per foot:
C_STRIDE = 8
C_LEVER = 0  # sensor to pivot of the foot, body frame, m
C_STILL_RATE = 3  # standstill angular rate, rad/s
C_STILL_NORM = 6  # standstill specific force norm, m/s^2
C_INCREMENTS = 7  # what the samples are, one of:
AVERAGED, COMPENSATED, SAMPLED = 0.0, 1.0, 2.0

# --- the walk's own statistic, for the threshold of the detector; per foot -----------------------
BINS = 128  # of the statistic, 20 a decade
HISTORY = 256  # values kept, some four seconds
D_FOOT = C_FOOT + 2 * C_STRIDE
D_HISTOGRAM = 0  # count of values in each bin
D_VALUES = BINS  # bin of each value, a ring
D_COUNT = BINS + HISTORY  # values taken
D_SKIP = D_COUNT + 1  # samples until the next value is taken
D_ACTIVE = D_COUNT + 2  # samples for which the foot still counts as walking
D_THRESHOLD = D_COUNT + 3  # threshold in use
D_LEAST = D_COUNT + 4  # least statistic of the candidate stance
D_STRIDE = D_COUNT + 8
D_EDGES = D_FOOT + 2 * D_STRIDE  # upper edge of each bin

# --- samples of a standing foot, for its gyro bias; per foot -------------------------------------
A_FOOT = D_EDGES + BINS
A_SECONDS = 0  # length of the window so far
A_COUNT = 1  # samples in it
A_SUM = 2  # of the angular rate, 3
A_SQUARES = 5  # 3
A_STRIDE = 8

# --- acceleration of both feet while they stand, for a floor that moves --------------------------
F_SECONDS = A_FOOT + 2 * A_STRIDE  # length of the window so far
F_SUM = F_SECONDS + 1  # velocity gained in it by the left and the right foot, m/s, 3 each
F_REST = F_SUM + 6  # acceleration of both feet in earlier windows of the stand, m/s^2, 3 each
F_NEWEST = F_REST + 6  # the same of the newest window, which may already be a start
F_WINDOWS = F_NEWEST + 6  # quiet windows of the stand

# --- scratch -------------------------------------------------------------------------------------
LINE = 8  # numbers of a line of the cache, at one of which begins what is taken several at once
S_A = F_WINDOWS + LINE - F_WINDOWS % LINE  # a block of ROW rows
SIDE = ROW  # error state of one foot in a vector of both: 15 and one pad
JOINT = 2 * SIDE  # error state of both feet, left then right
ROWS_MOST = 3  # rows of a measurement
S_G = S_A + ROW * ROW  # P H', a column of JOINT a row of the measurement
S_H = S_G + ROWS_MOST * JOINT  # measurement matrix, rows of JOINT
S_K = S_H + ROWS_MOST * JOINT  # gain, a column of JOINT a row of the measurement
S_PC = S_K + ROWS_MOST * JOINT  # P times each considered state, columns of JOINT
S_DX = S_PC + CONSIDERED * JOINT  # estimated error state of both feet
S_CC = S_DX + JOINT  # [P_cc, P_c H'] of the considered states, then [U, X]
ROW_CC = SIDE  # its row
X_CC = CONSIDERED  # from the start of a row to its part of P_c H', one number a row of H
S_GC = S_CC + CONSIDERED * ROW_CC  # P_c H' kept
ROW_GC = 4  # its row, padded
S_L = S_GC + CONSIDERED * ROW_GC  # factor of the innovation covariance, 3x3
S_S = S_L + ROWS_MOST * ROWS_MOST  # innovation covariance, 3x3
S_Y = S_S + ROWS_MOST * ROWS_MOST  # innovation
S_CDT = S_Y + ROWS_MOST  # R_nb dt, 3x3
S_SF = S_CDT + 9  # velocity increment in navigation axes, 3
S_ROTATION = S_SF + 3  # a 3x3 rotation increment
S_TMP = S_ROTATION + 9  # a 3x3
S_ALPHA = S_TMP + 9  # rotation increment of the interval, rad
S_GAMMA = S_ALPHA + 3  # velocity increment of the interval, m/s

# --- what the last epoch was, for the output row ------------------------------------------------
ZUPT_INFO = 13  # innovation 3, then:
Z_S = 3  # S, 3x3
Z_NIS = 12
Z_LEFT = S_GAMMA + 3
Z_RIGHT = Z_LEFT + ZUPT_INFO
GLRT_LEFT = Z_RIGHT + ZUPT_INFO
GLRT_RIGHT = GLRT_LEFT + 1

# --- the array of what acts at a stance, beside ``w`` --------------------------------------------
X_Y = 0  # innovation (3,)
X_NOISE = X_Y + ROWS_MOST  # variances of it that are not of the state (3,)
X_S = X_NOISE + ROWS_MOST  # innovation covariance (3, 3)
X_BEFORE = X_S + ROWS_MOST * ROWS_MOST  # separation of the feet (3,) m that was constrained
X_NOW = X_BEFORE + 3  # what it is at the time of the constraint
X_AFTER = X_NOW + 3  # the same as X_BEFORE with the constraint
X_DISTANCE, X_LATERAL = X_AFTER + 3, X_AFTER + 4  # of X_BEFORE: length, component to the left, m
X_DISTANCE_AFTER = X_LATERAL + 1  # length at the time of the constraint, with it, m
X_TARGET = X_LATERAL + 2  # distance or spacing it has been brought to, m
X_EXCEEDS = X_LATERAL + 3  # 1 where the distance exceeds that
X_NIS = X_LATERAL + 4  # of the constraint
X_VELOCITY = X_NIS + 1  # of a landing (3,) m/s
X_TOLD = X_VELOCITY + 3  # what is before this is told of a constraint

# --- scratch of `closest`, in the same array -----------------------------------------------------
M_R = X_TOLD  # separation of the feet (3,) m
M_P = M_R + 3  # its covariance (3, 3) m^2
M_AXES = M_R + 12  # principal axes of it, one a row
M_ALONG, M_VARIANCES, M_AT = M_R + 21, M_R + 24, M_R + 27  # along them: r, variances, solution
M_DIRECTION, M_PUSH, M_NOISE = M_R + 30, M_R + 33, M_R + 34  # result: row (3,), m, variance m^2
X_SIZE = M_R + 35

# --- what to do at the end of a stance, where that is no question for Python ---------------------
R_KIND = 0  # one of:
R_SPACING, R_DISTANCE = 1.0, 2.0  # the entry constrain_spacing, or constrain_distance
R_SHARE = 1  # of the stance, where the moment of the constraint is
R_LONGEST_S = 2  # s, of a stance that is a step
R_STD = 3  # m, scatter of the spacing or of the distance
R_HEIGHT_STD = 4  # m, as constrain_spacing takes it, and the next two
R_LATERAL = 5
R_LEFT_ALONE = 6
R_ROWS = 7  # rows of the measurement
R_LEARNS = 8  # 1 where the spacing is learnt
R_SIZE = 9
END_NO_STEP, END_DONE, END_ASK = 0, 1, 2  # what was done; or it is a question for Python

# --- the array of the spacing that is learnt, a filter of its own --------------------------------
L_STATE = 0  # spacing, placement (2,), advance a passing, m
L_COVARIANCE = 4  # of them (4, 4) m^2
L_BEGUN = 20  # 1 once there is a
L_FREE = 21  # separation (2,) m as it would be without constraints
L_AFTER = 23  # separation (2,) m after the newest of them
L_SIZE = 25

# --- rings (length n[N_RING]) --------------------------------------------------------------------
RINGS = GLRT_RIGHT + LINE - GLRT_RIGHT % LINE  # history first, snapshots after it
SAMPLE = 2 * LINE  # dt, 12 values, pads

# --- int64 workspace -----------------------------------------------------------------------------
N_RING = 0  # length of the rings, epochs
N_EPOCH = 1  # newest epoch, -1 before the first
N_WINDOW = 2  # GLRT window, samples
N_MIN_STANCE = 3  # samples
N_MIN_SWING = 4  # samples
N_NOTICE = 5  # bits below, set by an epoch that needs the tracker's attention
N_OLDEST = 6  # oldest epoch whose snapshot is valid
N_STILL = 7  # samples after which a stance is a standstill
N_SHORT_STANCE = 8  # samples of a short stance, if it is clear
N_DECIMATE = 9  # samples to one value of the statistic's history
N_WALKING = 10  # samples for which a foot counts as walking after a swing
N_SETTLED = 11  # samples without a turn after which a foot has come to rest on its floor
N_STANDS = 12  # samples after which a stance is one of a stop
N_LONGEST = 13  # ns between two samples above which some are missing between them
N_PAIRS = 14  # pairs that `take_pair` has taken since their number was asked for
N_UNEVEN = 15  # newest epoch whose interval was not nearly the nominal one, -1 for none
N_MOMENT = 16  # epoch of the constraint at the newest end of a stance
N_FOOT = 17  # then per foot:
N_STRIDE = 8
N_PHASE = 0  # one of the phases below
N_START = 1  # first epoch of the (candidate) stance
N_LEAVE = 2  # first epoch after it
N_BACK = 3  # first epoch with samples since the foot was missing
N_GONE = 4  # 1 while the foot has no samples
N_TURNED = 5  # newest epoch in which the foot turned
N_FLAGS = N_FOOT + 2 * N_STRIDE  # ring of flags: bit 0, 1 zero velocity left, right
FLAG_STILL = 4  # bits 2, 3: ... and standing still

SWING, LANDING, STANCE, LEAVING = 0, 1, 2, 3

# notices; the right foot's are shifted by NOTICE_SHIFT
STANCE_FALSE, STANCE_CONFIRMED, SWING_FALSE, STANCE_ENDED = 1, 2, 4, 8
NOTICE_SHIFT = 4
NOTICE_WATCH = 256  # the feet are farther apart than the method allows
NOTICE_STOOD = 512  # a window of a standing left foot is complete; twice that for the right
NOTICE_GONE = 2048  # the left foot has no sample any more; twice that for the right
NOTICE_BACK = 8192  # the left foot has samples again; twice that for the right
NOTICE_FLOOR = 32768  # both feet gain velocity alike while they stand, or the floor moves
STOOD_S = 0.75  # length of that window

NOT_TAKEN, TAKEN, TO_ATTEND = 0, 1, 2  # what `take_pair` returns

# --- output row ----------------------------------------------------------------------------------
O_FOOT = 55  # stride from left to right
O_POS = 0
O_VEL = 3
O_QUAT = 6
O_STANCE = 10
O_RATE = 11
O_COV_POS = 14  # 3x3 each
O_COV_VEL = 23
O_COV_ATT = 32
O_ZUPT = 41  # innovation 3, S 9, NIS
O_PRESENT = 54  # 1 where the foot had a sample
O_RELATIVE = 2 * O_FOOT  # covariance of left minus right position, 3x3
OUT = O_RELATIVE + 9
K_VEL, K_QUAT = O_VEL, O_QUAT  # what a trajectory keeps of it begins with the position
KEPT = O_QUAT + 4  # of a foot
TOLD_BLOCK = 9 * ROW  # of a covariance block: position, velocity and attitude
TOLD = OUT + 3 * TOLD_BLOCK  # what is told of a live epoch: the row, then left, right, cross


def position_row(foot: int, axis: int) -> int:
    """Return the number of the error state "position of ``foot`` along ``axis``", 0 to 29."""
    return ERRORS * foot + E_POS + axis


def velocity_row(foot: int, axis: int) -> int:
    """Return the number of the error state "velocity of ``foot`` along ``axis``", 0 to 29."""
    return ERRORS * foot + E_VEL + axis


def attitude_row(foot: int, axis: int) -> int:
    """Return the number of the error state "attitude of ``foot`` about ``axis``", 0 to 29."""
    return ERRORS * foot + E_ATT + axis


def gyro_bias_row(foot: int, axis: int) -> int:
    """Return the number of the error state "gyro bias of ``foot`` about ``axis``", 0 to 29."""
    return ERRORS * foot + E_BG + axis


def workspace_size(ring: int) -> int:
    """Return the number of float64 of a workspace with rings of ``ring`` epochs."""
    return RINGS + ring * (SAMPLE + STATE)


def integer_size(ring: int) -> int:
    """Return the number of int64 of a workspace with rings of ``ring`` epochs."""
    return N_FLAGS + ring
