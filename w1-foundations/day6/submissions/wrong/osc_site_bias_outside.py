# task 6.3: site-bias-not-weighed
# Lambda times acc only.


def osc_torque(J, Lambda, bias, site_bias, acc):
    return J.T @ (Lambda @ acc - site_bias) + bias
