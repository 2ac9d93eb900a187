/* Epochs of training in plain C: equations (1)-(5) with the adjoint of network/rollout.py,
   one core, float32. UNITS, padded to the width of a vector, IO, MOTIONS and STEPS are set by the
   compiler's options. An array [UNITS] of context units has the same place as the network's;
   what pads has no weights. Built by benchmarks/epoch_floor.py. */

#include <math.h>

typedef float Rows[MOTIONS][UNITS];

static float weights_in[UNITS][UNITS];   /* epsilon_i w_ij, sender j first */
static float weights_out[UNITS][UNITS];  /* epsilon_i w_ij, receiver i first */
static float gradient[UNITS][UNITS];     /* dE/dw_ij, receiver i first */
static Rows u[STEPS], y[STEPS], x[STEPS], outer[STEPS], delta[STEPS];

/* rows += factors . matrix */
static void add_product(Rows rows, const float factors[MOTIONS][UNITS],
                        const float matrix[UNITS][UNITS]) {
    for (int motion = 0; motion < MOTIONS; motion++) {
        float sum[UNITS];
        for (int i = 0; i < UNITS; i++) sum[i] = rows[motion][i];
        for (int j = 0; j < UNITS; j++)
            for (int i = 0; i < UNITS; i++) sum[i] += factors[motion][j] * matrix[j][i];
        for (int i = 0; i < UNITS; i++) rows[motion][i] = sum[i];
    }
}

static void forward(const float *bias, const float *rate, const float *sensed, const float *share) {
    for (int t = 0; t < STEPS; t++) {
        for (int motion = 0; motion < MOTIONS; motion++)
            for (int i = 0; i < UNITS; i++)
                x[t][motion][i] = y[t][motion][i] = 1 / (1 + expf(-u[t][motion][i]));
        for (int motion = 0; motion < MOTIONS; motion++)
            for (int i = 0; i < IO; i++) {
                int at = (t * MOTIONS + motion) * IO + i;
                x[t][motion][i] = share[at] * sensed[at] + (1 - share[at]) * y[t][motion][i];
            }
        if (t == STEPS - 1) break;
        for (int motion = 0; motion < MOTIONS; motion++)
            for (int i = 0; i < UNITS; i++)
                u[t + 1][motion][i] = (1 - rate[i]) * u[t][motion][i] + rate[i] * bias[i];
        add_product(u[t + 1], x[t], weights_in);
    }
}

/* Return the error; what it is to the potentials of IO is left in `outer`. */
static float error(const float *sensed, const float *weight) {
    float sum = 0;
    for (int t = 1; t < STEPS; t++)
        for (int motion = 0; motion < MOTIONS; motion++)
            for (int i = 0; i < IO; i++) {
                int at = (t * MOTIONS + motion) * IO + i;
                float out = y[t][motion][i], off = out - sensed[at];
                sum += weight[at] * off * off;
                outer[t][motion][i] = 2 * weight[at] * off * out * (1 - out);
            }
    return sum;
}

static void backward(const float *rate, const float *share) {
    for (int motion = 0; motion < MOTIONS; motion++)
        for (int i = 0; i < UNITS; i++) delta[STEPS - 1][motion][i] = outer[STEPS - 1][motion][i];
    for (int t = STEPS - 2; t >= 0; t--) {
        Rows back = {{0}};
        add_product(back, delta[t + 1], weights_out);
        for (int motion = 0; motion < MOTIONS; motion++)
            for (int i = 0; i < IO; i++)
                back[motion][i] *= 1 - share[(t * MOTIONS + motion) * IO + i];
        for (int motion = 0; motion < MOTIONS; motion++)
            for (int i = 0; i < UNITS; i++) {
                float out = y[t][motion][i];
                delta[t][motion][i] = outer[t][motion][i] + (1 - rate[i]) * delta[t + 1][motion][i]
                                      + out * (1 - out) * back[motion][i];
            }
    }
}

static void gradients(const float *rate, float *of_bias) {
    for (int i = 0; i < UNITS; i++) {
        of_bias[i] = 0;
        for (int j = 0; j < UNITS; j++) gradient[i][j] = 0;
    }
    for (int t = 0; t < STEPS - 1; t++)
        for (int motion = 0; motion < MOTIONS; motion++)
            for (int i = 0; i < UNITS; i++) of_bias[i] += rate[i] * delta[t + 1][motion][i];
    for (int i = 0; i < UNITS; i++) {
        float sum[UNITS] = {0};
        for (int t = 0; t < STEPS - 1; t++)
            for (int motion = 0; motion < MOTIONS; motion++) {
                float factor = delta[t + 1][motion][i];
                for (int j = 0; j < UNITS; j++) sum[j] += factor * x[t][motion][j];
            }
        for (int j = 0; j < UNITS; j++) gradient[i][j] = rate[i] * sum[j];
    }
}

static void update(float *values, float *memory, const float *slope, float rate, float momentum,
                   int count) {
    for (int i = 0; i < count; i++) {
        memory[i] = momentum * memory[i] + slope[i];
        values[i] -= rate * memory[i];
    }
}

/* weights, wired [UNITS][UNITS] receiver first; bias, rate (1 / tau) [UNITS]; initial
   [MOTIONS][UNITS], of which context moves; sensed, share, weight [STEPS][MOTIONS][IO]; the three
   memories are as what they are of. */
void epochs(int count, float *weights, float *bias, float *initial, float *weights_memory,
            float *bias_memory, float *initial_memory, const float *wired, const float *rate,
            const float *sensed, const float *share, const float *weight, float weight_rate,
            float initial_rate, float momentum, float *losses) {
    float of_bias[UNITS];
    for (int epoch = 0; epoch < count; epoch++) {
        for (int i = 0; i < UNITS; i++)
            for (int j = 0; j < UNITS; j++)
                weights_out[i][j] = rate[i] * wired[i * UNITS + j] * weights[i * UNITS + j];
        for (int i = 0; i < UNITS; i++)
            for (int j = 0; j < UNITS; j++) weights_in[j][i] = weights_out[i][j];
        for (int motion = 0; motion < MOTIONS; motion++)
            for (int i = 0; i < UNITS; i++) u[0][motion][i] = initial[motion * UNITS + i];
        forward(bias, rate, sensed, share);
        losses[epoch] = error(sensed, weight);
        backward(rate, share);
        gradients(rate, of_bias);
        for (int i = 0; i < UNITS; i++)
            for (int j = 0; j < UNITS; j++) gradient[i][j] *= wired[i * UNITS + j];
        for (int motion = 0; motion < MOTIONS; motion++)
            for (int i = 0; i < IO; i++) delta[0][motion][i] = 0;
        update(weights, weights_memory, &gradient[0][0], weight_rate, momentum, UNITS * UNITS);
        update(bias, bias_memory, of_bias, weight_rate, momentum, UNITS);
        update(initial, initial_memory, &delta[0][0][0], initial_rate, momentum, MOTIONS * UNITS);
    }
}
