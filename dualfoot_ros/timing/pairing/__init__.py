"""Two streams to pairs with equal stamps: streaming, and its batch twin."""
